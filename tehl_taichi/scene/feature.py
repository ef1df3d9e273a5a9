"""Surface features of body a: what they are and how far they reach."""

import math
import os
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.height_map import MICRO, UNITS
from tehl_taichi.scene.measured import Measured
from tehl_taichi.values.quantity import check, choice, count, quantity, text

SHAPES = ("cosine", "ridge", "furrow", "waviness", "rough", "map")
RIDGE_REACH = 0.7  # of its width: 10^(-10 0.7^2) is 1e-5 of the height
LEVELS = ("none", "mean", "plane")
PATCHES = ("waviness", "rough", "map")
USED_BY = {"width": SHAPES[:-1], "length": ("cosine", "waviness"), "extent_x": PATCHES, "extent_y": PATCHES, "taper": PATCHES,
           "seed": ("rough",), "pixel": ("map",), "level": ("map",)}  # keys that not every shape has; the others ignore them


@dataclass(frozen=True)
class Feature(Measured):
    """One feature of surface a; the other features stand x and y from the first.

    cosine: a bump or dent. ridge, furrow: transverse, the same for every y. waviness: amplitude `height`, wavelengths width
    and length. rough: rms `height`, wavelengths from `width` up to the patch, random with `seed`, even in y. map: heights
    measured on a grid, rows along y. waviness, rough and map fill a patch extent_x by extent_y and fade out at its rim.
    """

    shape: str = choice("cosine", "what it is", SHAPES)
    height: float = quantity(1.5e-6, "m", "height, negative: dent; waviness: amplitude; rough: rms", -1e-3, 1e-3)
    width: float = quantity(200e-6, "m", "along x; waviness: wavelength; rough: shortest wavelength", 1e-6, 0.1)
    length: float = quantity(0.0, "m", "cosine: along y, 0: as wide; waviness: wavelength along y, 0: transverse", 0.0, 0.1)
    x: float = quantity(0.0, "m", "centre, ahead of the first feature", -0.1, 0.1)
    y: float = quantity(0.0, "m", "centre", -0.1, 0.1)
    extent_x: float = quantity(0.0, "m", "waviness, rough, map: length of the patch; map: 0: the whole map", 0.0, 0.1)
    extent_y: float = quantity(0.0, "m", "waviness, rough, map: its width; 0: without end, map: the whole map", 0.0, 0.1)
    taper: float = quantity(0.0, "m", "waviness, rough, map: distance over which the patch fades out at its rim", 0.0, 0.1)
    seed: int = count(1, "rough: of its random numbers", 0, 2**31)
    file: str = text("", "map: CSV or NPY file (others with the `topography` extra), rows along y; a path in a scene file "
                     "starts at that file", most=4096, compare=False)
    unit: str = choice("", "map: of the heights in its file", ("", *UNITS))
    scale: float = quantity(1.0, "", "map: its heights are multiplied with it; -1 turns them over, as for a replica", -1e3, 1e3)
    pixel: float = quantity(0.0, "m", "map: distance of its points; 0: not given", 0.0, 1e-2)
    level: str = choice("plane", "map: what is taken off its heights", LEVELS)
    sha256: str = text("", "map: of its heights, filled in when they are read; a file with other heights is refused then")

    def __post_init__(self):
        if isinstance(self.file, os.PathLike):
            object.__setattr__(self, "file", os.fspath(self.file))
        if isinstance(self.unit, str):
            object.__setattr__(self, "unit", self.unit.translate(MICRO))
        check(self, "feature")
        self.take_map() if self.shape == "map" else self._check_shape()

    def _check_shape(self):
        if self.shape == "furrow" and self.height > 0:
            raise SceneError(f"feature.height = {self.height:g} m must be negative for a furrow")
        if self.shape in ("waviness", "rough") and self.extent_x <= 0:
            raise SceneError(f"feature.extent_x = {self.extent_x:g} m: {self.shape} needs the length of its patch, more "
                             "than 0 m")
        for key in ("file", "unit"):
            if getattr(self, key):
                raise SceneError(f"feature.{key} = {getattr(self, key)!r} needs shape = 'map', not {self.shape!r}")

    @property
    def top(self):
        """Largest height (m)."""
        return self.measures.high if self.shape == "map" else self.height

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
        length, width = self.size if self.shape == "map" else (0.0, math.inf)
        return self.extent_x or length, self.extent_y or width

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
