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

    uses: {key that several shapes share: what it means to this one, "" where its own sentence says it}; keys: frozen
    dataclass of keys that only this one has; example: keys of a small feature that passes the gear contact on 128 x 32 cells,
    for suites and tests; drawn: whether height (of both signs) and width alone make one, so that suites draw it at random.
    """

    uses: Mapping[str, str]
    keys: Optional[type] = None
    example: Mapping = field(default_factory=dict)
    drawn: bool = False

    measured = False  # whether its heights come from a file: a store keeps them
    rough = False  # whether its heights fill its patch, so that it has a roughness; it has `patch` and `finest` then

    def height(self, f, x, y):
        """Height (positive: out of the surface) at x, y from its centre; arrays that broadcast, and so does the result."""
        raise NotImplementedError(f"{self.name} has no height")

    def filled(self, f, x, y):
        """Whether its height there is no measured one; arrays that broadcast, and so does the result."""
        return np.zeros(np.broadcast(x, y).shape, bool)

    def reach(self, f):
        """Distance along x from its centre within which it is not zero."""
        return f.width / 2

    def reach_y(self, f):
        """Distance along y; 0 where nothing varies along y."""
        return 0.0

    def transverse(self, f):
        """True when nothing varies along y."""
        return False

    def symmetric(self, f):
        """True when the half domain y >= 0 says it all."""
        return self.transverse(f) or f.y == 0

    def top(self, f):
        """Largest height."""
        return f.height

    def sizes(self, f):
        """({key: length along x}, {key: length along y}) that the cells of a grid must be able to see."""
        return {"width": f.width}, {}

    def coarser(self, f, x, y):
        """What of it a grid sees that needs waves of x, y (m): without those of a sum of many that are shorter; None where
        nothing of that is left."""
        return f

    def tidy(self, f):
        """Give its own keys the form in which they are checked (they may be of any type yet)."""

    def check(self, f):
        """Refuse keys that do not fit together. Raises SceneError."""

    def preview(self, f, scene):
        """Lines printed before a run."""
        return ()

    def doubts(self, f, scene):
        """Sentences about what is doubtful."""
        return ()


def shared_key_meaning(shapes, key, about):
    """Meaning of a key that shapes share, for the template: who uses it, and what it says to whom."""
    users = {name: shape.uses[key] for name, shape in shapes.items() if key in shape.uses}
    others = [name for name in shapes if name not in users]
    whose = f" (not {others[0]})" if len(others) == 1 else f" ({', '.join(users)})" if others else ""
    return "; ".join([about + whose, *(f"{name}: {meaning}" for name, meaning in users.items() if meaning)])


def share(where, expected, x, y, **keys):
    """A number of a shape: its height at x, y (m)."""
    def compute():
        from tehl_taichi.scene.feature import Feature  # which is made of all shapes

        f = Feature(**keys)
        return float(f.height_at(np.array([x]), np.array([y]))[0]) / f.top

    return Checked(where, expected, compute)


def needs_patch(f):
    """Refuse a patch without a length."""
    if f.extent_x <= 0:
        raise SceneError(f"feature.extent_x = {f.extent_x:g} m: {f.shape} needs the length of its patch, more than 0 m")
