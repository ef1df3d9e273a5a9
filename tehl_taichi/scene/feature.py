"""Surface features of body a: what they are and how far they reach."""

import math
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.checks import choice, integer, normalise, number, text
from tehl_taichi.scene.height_map import check_file, read

SHAPES = ("cosine", "ridge", "furrow", "waviness", "rough", "map")
RIDGE_REACH = 0.7  # of its width: 10^(-10 0.7^2) is 1e-5 of the height
LEVELS = ("none", "mean", "plane")
PATCHES = ("waviness", "rough", "map")
USED_BY = {"width": SHAPES[:-1], "length": ("cosine", "waviness"), "extent_x": PATCHES, "extent_y": PATCHES, "taper": PATCHES,
           "seed": ("rough",), "pixel": ("map",), "level": ("map",)}  # keys that not every shape has; the others ignore them


@dataclass(frozen=True)
class Feature:
    """One feature. height m (negative: dent), width m, x m ahead of the first feature, y m (all from its centre).

    cosine: bump or dent of that width; length m along y (0: as wide). ridge, furrow: transverse, the same for every y.
    waviness: amplitude `height`, wavelengths width (x) and length (y; 0: transverse). rough: rms `height`, wavelengths
    from `width` up to the patch, random with `seed`, even in y. map: heights measured on a grid (file: CSV or NPY, rows
    along y, with pixel m; other formats with the `topography` extra), multiplied with `height` m per unit of the file,
    levelled. waviness, rough and map fill a patch extent_x by extent_y m (0: a map's own size; in y without end) and
    fade out over `taper` m at its rim.
    """

    shape: str = "cosine"
    height: float = 1.5e-6
    width: float = 200e-6
    length: float = 0.0
    x: float = 0.0
    y: float = 0.0
    extent_x: float = 0.0
    extent_y: float = 0.0
    taper: float = 0.0
    seed: int = 1
    file: str = ""
    pixel: float = 1e-6
    level: str = "plane"

    def __post_init__(self):
        normalise(self)
        text("feature.file", self.file, 4096)
        choice("feature.shape", self.shape, SHAPES)
        highest = 1e3 if self.shape == "map" else 1e-3
        number("feature.height", self.height, "m", -highest, highest)
        number("feature.width", self.width, "m", 1e-6, 0.1)
        for key in ("length", "extent_x", "extent_y", "taper"):
            number(f"feature.{key}", getattr(self, key), "m", 0.0, 0.1)
        for key in ("x", "y"):
            number(f"feature.{key}", getattr(self, key), "m", -0.1, 0.1)
        integer("feature.seed", self.seed, 0, 2**31)
        number("feature.pixel", self.pixel, "m", 1e-9, 1e-2)
        choice("feature.level", self.level, LEVELS)
        self._check_shape()

    def _check_shape(self):
        if self.shape == "furrow" and self.height > 0:
            raise SceneError(f"feature.height = {self.height:g} m must be negative for a furrow")
        if self.shape in ("waviness", "rough") and self.extent_x <= 0:
            raise SceneError(f"feature.extent_x = {self.extent_x:g} m: {self.shape} needs the length of its patch, more "
                             "than 0 m")
        if self.shape == "map":
            check_file(self.file)
        elif self.file:
            raise SceneError(f"feature.file = {self.file!r} needs shape = 'map', not {self.shape!r}")

    @property
    def reach(self):
        """Distance (m) along x from its centre within which the feature is not zero."""
        if self.shape == "cosine":
            return self.width / 2
        if self.shape in ("ridge", "furrow"):
            return RIDGE_REACH * self.width
        return self.patch[0] / 2

    @property
    def reach_y(self):
        """The same along y; 0 for transverse features, which are the same for every y."""
        if self.shape == "cosine":
            return (self.length or self.width) / 2
        return 0.0 if self.transverse else self.patch[1] / 2

    @property
    def patch(self):
        """(length along x, along y) in m of the patch of a waviness, rough or map feature."""
        if self.shape != "map":
            return self.extent_x, self.extent_y or math.inf
        rows, columns = read(self.file, self.level).shape
        return self.extent_x or (columns - 1) * self.pixel, self.extent_y or (rows - 1) * self.pixel

    @property
    def transverse(self):
        """True when nothing varies along y."""
        if self.shape == "waviness":
            return self.length == 0 and self.extent_y == 0
        return self.shape in ("ridge", "furrow")

    @property
    def symmetric(self):
        """True when the half domain y >= 0 says it all."""
        return self.transverse or (self.y == 0 and self.shape != "map")
