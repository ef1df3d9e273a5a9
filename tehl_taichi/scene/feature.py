"""Surface features: keys that several shapes share, keys of single shapes, and quantities that the shape computes from them."""

from dataclasses import dataclass
from typing import Any

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface import shapes
from tehl_taichi.scene.surface.maps import height_map
from tehl_taichi.scene.surface.shape import Shape, shared_key_meaning
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.quantity import Choice, Switch, Text, check, choice, documented, kinds, quantity
from tehl_taichi.values.registry import collect

SHAPES = collect(shapes, Shape)
OWN = tuple(shape.keys for shape in SHAPES.values() if shape.keys)
# {key that not every shape has: names of those that look at it}; the others ignore it
USED_BY = {key: tuple(name for name, shape in SHAPES.items() if key in shape.uses)
           for key in dict.fromkeys(key for shape in SHAPES.values() for key in shape.uses)}
for owner, shape in SHAPES.items():
    USED_BY |= {key: (owner, *USED_BY.get(key, ())) for key in (kinds(shape.keys) if shape.keys else ())}
LARGEST = 0.03  # m: contacts are a millimetre wide, 0.05 was meant in mm
OF_HEIGHTS = ("shape", "sha256", "file")  # keys that follow from the heights of an array


def _about(key, general):
    return shared_key_meaning(SHAPES, key, general)


@dataclass(frozen=True)
class SharedKeys:
    """Keys that several shapes share."""

    shape: str = choice("cosine", "shape of the feature (`tehl scenes`)", tuple(SHAPES))
    surface: str = choice("a", "surface that carries it", ("a", "b"))
    height: float = quantity(1.5e-6, "m", _about("height", "height"), -1e-3, 1e-3)
    width: float = quantity(200e-6, "m", _about("width", "size along x"), 1e-6, LARGEST)
    length: float = quantity(0.0, "m", _about("length", "size along y"), 0.0, LARGEST, infinite=True, usual=5e-4)
    x: float = quantity(0.0, "m", "centre, ahead of a first feature with x = 0", -LARGEST, LARGEST, usual=1e-4)
    y: float = quantity(0.0, "m", "centre, from the middle of the contact", -LARGEST, LARGEST, usual=1e-4)
    extent_x: float = quantity(0.0, "m", _about("extent_x", "length of the patch"), 0.0, LARGEST, usual=5e-4)
    extent_y: float = quantity(0.0, "m", _about("extent_y", "width of the patch; 0: unlimited"), 0.0, LARGEST, usual=5e-4)
    taper: float = quantity(0.0, "m", _about("taper", "distance over which the heights fade out at the rim of the "
                                                      "patch"), 0.0, LARGEST,
                            usual=5e-5)


_KEYS: Any = type("_KEYS", (*OWN, SharedKeys), {})  # those of every shape


@documented
class Feature(_KEYS):
    """Feature of a surface.

    x is measured from the centre of a first feature with x = 0 (on the other surface: from its position when it is at X = 0),
    y from the middle of the contact. `tehl scenes` lists the shapes and their keys. Heights in an array: :meth:`from_heights`.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.Feature(shape="furrow", height=-2e-6, width=500e-6)
    Feature(shape='furrow', height=-2e-06, width=0.0005)
    >>> float(tehl.Feature(height=1e-6, width=200e-6).height_at(0.0, 0.0))
    1e-06
    """

    @classmethod
    def from_heights(cls, heights: Any, pixel: float, pixel_y: float = 0.0, *, unit: str = "m", **keys: Any) -> "Feature":
        """Make a feature (shape "map" or "profile") of heights in an array.

        Parameters
        ----------
        heights : array (rows, columns) or (points,)
            At least 4 x 4, a row per line of points along x, or a line profile; nan or masked where nothing was measured.
        pixel, pixel_y : float
            Distances in m of the points in a row, and of the rows (default: pixel).
        unit : {"m", "mm", "um", "nm"}
            Unit of the heights.
        **keys
            Further keys of a map or profile: level, cutoff, scale, taper, lay, x, y ...

        Returns
        -------
        Feature
            It holds a copy of the heights, and stores of its runs do.

        Raises
        ------
        SceneError
            The heights are no such array, or a key is out of range.

        Examples
        --------
        >>> import numpy as np
        >>> import tehl_taichi as tehl
        >>> z = 1e-6 * np.cos(np.linspace(-1.5, 1.5, 64)) * np.cos(np.linspace(-1.5, 1.5, 48))[:, None]
        >>> bump = tehl.Feature.from_heights(z, pixel=4e-6, level="none")
        >>> f"{bump.top * 1e6:.2f} um, {bump.size[0] * 1e6:.0f} x {bump.size[1] * 1e6:.0f} um"
        '1.00 um, 252 x 188 um'
        """
        for key in (key for key in OF_HEIGHTS if key in keys):
            raise SceneError(f"from_heights: {key} = {shown(keys[key])} has no effect; the heights decide it, remove {key}")
        sha256, held = height_map.of_array(heights)
        shape = "profile" if height_map.is_profile(held) else "map"
        made = cls(shape=shape, sha256=sha256, unit=unit, pixel=pixel, pixel_y=pixel_y, **keys)
        del held  # the feature holds them now
        return made

    def __post_init__(self):
        for shape in SHAPES.values():
            shape.tidy(self)
        check(self, "feature")
        self.kind.check(self)
        self._check_strangers()

    def _check_strangers(self):
        """Refuse texts and switches that belong to another shape: the user probably means that shape."""
        for key in (key for keys in OWN for key, kind in kinds(keys).items() if isinstance(kind, (Text, Choice, Switch))):
            if self.shape not in USED_BY[key] and getattr(self, key) and not getattr(type(self), key):
                needed = " or ".join(map(repr, USED_BY[key]))
                raise SceneError(f"feature.{key} = {getattr(self, key)!r} needs shape = {needed}, not {self.shape!r}")

    @property
    def kind(self):
        """Entry of its shape."""
        return SHAPES[self.shape]

    def height_at(self, x, y):
        """Height (m) at x, y (m, arrays) from its centre; positive out of the surface, negative in a furrow or dent."""
        return self.kind.height(self, x, y)

    @property
    def top(self):
        """Largest height (m)."""
        return self.kind.top(self)

    @property
    def reach(self):
        """Distance (m) along x from the centre within which the feature is not zero."""
        return self.kind.reach(self)

    @property
    def reach_y(self):
        """Distance (m) along y from the centre within which it is not zero; 0 for transverse features, which do not vary along
        y.
        """
        return self.kind.reach_y(self)

    @property
    def centre_y(self):
        """Position y (m) of the centre; 0 for transverse features, whose `y` has no effect."""
        return 0.0 if self.transverse else self.y

    @property
    def transverse(self):
        """True if the height does not vary along y."""
        return self.kind.transverse(self)

    @property
    def symmetric(self):
        """True if the half domain y >= 0 suffices."""
        return self.kind.symmetric(self)
