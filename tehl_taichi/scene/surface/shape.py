"""Base of the shapes of features: each shape is an entry of `scene/surface/shapes/`, one file."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Optional

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.values.registry import Checked, Entry

FINE = 24  # points of a wave that show it


@dataclass(frozen=True, kw_only=True)
class Shape(Entry):
    """Base of the shapes; `f` is always a :class:`tehl_taichi.scene.feature.Feature`, lengths are m.

    uses: {key that several shapes share: its meaning for this one, "" for the general meaning}; keys: frozen dataclass of keys
    that only this shape has; example: keys of a small feature that passes the gear contact on 128 x 32 cells, for suites and
    tests; drawn: height (of either sign) and width suffice, so suites draw it at random.
    """

    uses: Mapping[str, str]
    keys: Optional[type] = None
    example: Mapping = field(default_factory=dict)
    drawn: bool = False

    measured = False  # whether its heights come from a file: a store keeps them
    rough = False  # whether its heights fill its patch, so that it has a roughness; it has `patch` and `finest` then

    def height(self, f, x, y):
        """Height (positive: out of the surface) at x, y from its centre (arrays that broadcast)."""
        raise NotImplementedError(f"{self.name} has no height")

    def filled(self, f, x, y):
        """Whether the height at x, y (arrays that broadcast) is filled in, not measured."""
        return np.zeros(np.broadcast(x, y).shape, bool)

    def reach(self, f):
        """Distance along x from the centre within which the height is not zero."""
        return f.width / 2

    def reach_y(self, f):
        """Distance along y from the centre within which it is not zero; 0 without variation along y."""
        return 0.0

    def transverse(self, f):
        """True if the height does not vary along y."""
        return False

    def symmetric(self, f):
        """True if the half domain y >= 0 suffices."""
        return self.transverse(f) or f.y == 0

    def top(self, f):
        """Largest height; 0 of a dent in a flat surface."""
        return max(f.height, 0.0)

    def sizes(self, f):
        """({key: length along x}, {key: length along y}) that the grid must resolve."""
        return {"width": f.width}, {}

    def coarser(self, f, x, y):
        """The feature without waves shorter than x, y (m), which a coarser grid does not resolve; None if nothing is left."""
        return f

    def tidy(self, f):
        """Convert its own keys to the types that are checked (they may have any type before)."""

    def check(self, f):
        """Refuse keys that contradict each other. Raises SceneError."""

    def idle(self, f):
        """{key that it uses, but not with the other keys of this feature: reason}."""
        return {}

    def preview(self, f, scene):
        """Lines printed before a run."""
        return ()

    def doubts(self, f, scene):
        """Sentences about doubtful values."""
        return ()


def shared_key_meaning(shapes, key, about):
    """Meaning of a key that several shapes share, for the template: per shape."""
    users = {name: shape.uses[key] for name, shape in shapes.items() if key in shape.uses}
    others = [name for name in shapes if name not in users]
    whose = f" (not {others[0]})" if len(others) == 1 else f" ({', '.join(users)})" if others else ""
    return "; ".join([about + whose, *(f"{name}: {meaning}" for name, meaning in users.items() if meaning)])


def share(where, expected, x, y, **keys):
    """Check value of a shape: its height at x, y (m) over the size of its key `height`, over its top without one."""
    def compute():
        from tehl_taichi.scene.feature import Feature  # which is made of all shapes

        f = Feature(**keys)
        return float(f.height_at(np.array([x]), np.array([y]))[0]) / (abs(f.height) or f.top)

    return Checked(where, expected, compute)


def needs_patch(f):
    """Refuse a patch without a length."""
    if f.extent_x <= 0:
        raise SceneError(f"feature.extent_x = {f.extent_x:g} m: {f.shape} needs the length of its patch, more than 0 m")
