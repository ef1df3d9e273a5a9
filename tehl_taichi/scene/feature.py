"""Surface features of body a: the keys that shapes share, those of single shapes, and what the shape makes of them."""

from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.registry import collect
from tehl_taichi.scene import features
from tehl_taichi.scene.shape import Shape, told
from tehl_taichi.values.quantity import Choice, Switch, Text, check, choice, kinds, quantity

SHAPES = collect(features, Shape)
OWN = tuple(shape.keys for shape in SHAPES.values() if shape.keys)
# {key that not every shape has: names of those that look at it}; the others ignore it
USED_BY = {key: tuple(name for name, shape in SHAPES.items() if key in shape.uses)
           for key in dict.fromkeys(key for shape in SHAPES.values() for key in shape.uses)}
USED_BY |= {key: (name,) for name, shape in SHAPES.items() if shape.keys for key in kinds(shape.keys)}
LARGEST = 0.03  # m: contacts are a millimetre wide, 0.05 was meant in mm


def _about(key, general):
    return told(SHAPES, key, general)


@dataclass(frozen=True)
class Shared:
    """Keys that shapes share."""

    shape: str = choice("cosine", "what it is", tuple(SHAPES))
    height: float = quantity(1.5e-6, "m", _about("height", "height"), -1e-3, 1e-3)
    width: float = quantity(200e-6, "m", _about("width", "along x"), 1e-6, LARGEST)
    length: float = quantity(0.0, "m", _about("length", "along y"), 0.0, LARGEST, infinite=True, usual=5e-4)
    x: float = quantity(0.0, "m", "centre, ahead of the first feature", -LARGEST, LARGEST, usual=1e-4)
    y: float = quantity(0.0, "m", "centre", -LARGEST, LARGEST, usual=1e-4)
    extent_x: float = quantity(0.0, "m", _about("extent_x", "length of the patch"), 0.0, LARGEST, usual=5e-4)
    extent_y: float = quantity(0.0, "m", _about("extent_y", "its width; 0: without end"), 0.0, LARGEST, usual=5e-4)
    taper: float = quantity(0.0, "m", _about("taper", "distance over which the patch fades out at its rim"), 0.0, LARGEST,
                            usual=5e-5)


@dataclass(frozen=True)
class Feature(*OWN, Shared):
    """One feature of surface a; the other features stand x and y from the first.

    Its shape is an entry of `scene/features/`, which says what its keys mean.
    """

    def __post_init__(self):
        for shape in SHAPES.values():
            shape.tidy(self)
        check(self, "feature")
        self.kind.check(self)
        self._check_strangers()

    def _check_strangers(self):
        """Refuse words and switches that only another shape takes: whoever gives them means that shape."""
        for key in (key for keys in OWN for key, kind in kinds(keys).items() if isinstance(kind, (Text, Choice, Switch))):
            if self.shape not in USED_BY[key] and getattr(self, key) and not getattr(type(self), key):
                raise SceneError(f"feature.{key} = {getattr(self, key)!r} needs shape = {USED_BY[key][0]!r}, not "
                                 f"{self.shape!r}")

    @property
    def kind(self):
        """Its shape: the entry."""
        return SHAPES[self.shape]

    def height_at(self, x, y):
        """Height (m; positive: out of the surface, a furrow or dent has a negative one) at x, y (m) from its centre; arrays."""
        return self.kind.height(self, x, y)

    @property
    def top(self):
        """Largest height (m)."""
        return self.kind.top(self)

    @property
    def reach(self):
        """Distance (m) along x from its centre within which the feature is not zero."""
        return self.kind.reach(self)

    @property
    def reach_y(self):
        """The same along y; 0 for transverse features, which are the same for every y."""
        return self.kind.reach_y(self)

    @property
    def transverse(self):
        """True when nothing varies along y."""
        return self.kind.transverse(self)

    @property
    def symmetric(self):
        """True when the half domain y >= 0 says it all."""
        return self.kind.symmetric(self)
