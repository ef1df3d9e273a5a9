"""Heights measured on a grid."""

import dataclasses
import math
import os
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.maps import gaussian_filter, height_map, hole_filling, map_warnings
from tehl_taichi.scene.surface.maps.form import SurfaceForm
from tehl_taichi.scene.surface.maps.height_map import LEVELS, MICRO, UNITS, Measures
from tehl_taichi.scene.surface.maps.orientation import Orientation
from tehl_taichi.scene.surface.shape import share
from tehl_taichi.scene.surface.shapes.patch import Patch
from tehl_taichi.values.checks import number
from tehl_taichi.values.quantity import choice, quantity, switch, text

MAX_RANGE, MAX_SLOPE = 1e-4, 45.0  # m, degrees, of a map: beyond them no film, or a wrong unit or pixel
SAME = 0.02  # relative difference of a pixel and the distance of rounded coordinates
FARTHEST = 5e-4  # m, between points of a map: 0.001 was meant in mm


@dataclass(frozen=True)
class Measured:
    """Keys of a map, and what follows from them."""

    file: str = text("", "map: CSV or NPY file (others with the `topography` extra), each row a line of points along x; paths "
                         "are relative to the scene file", most=4096, compare=False)
    unit: str = choice("", "map: unit of the heights in the file", ("", *UNITS))
    scale: float = quantity(1.0, "", "map: factor for the heights; -1 inverts them, as for a replica", -1e3, 1e3)
    pixel: float = quantity(0.0, "m", "map: distance between points in a row of the file; 0: not given", 0.0, FARTHEST,
                            usual=1e-6)
    pixel_y: float = quantity(0.0, "m", "map: distance between rows of the file; 0: equal to pixel", 0.0,
                              FARTHEST, usual=1e-6)
    transpose: bool = switch(False, "map: the rows of the file run along y (across); pixel and pixel_y remain those of the "
                                    "file")
    mirror_x: bool = switch(False, "map: reverse the heights along x (after transpose)")
    mirror_y: bool = switch(False, "map: reverse the heights along y (after transpose)")
    level: str = choice("plane", "map: shape removed from the heights; form: plane and curvature", tuple(LEVELS))
    cutoff: float = quantity(0.0, "m", "map: Gaussian low-pass (ISO 16610-61), wavelength reduced to half its amplitude; 0: "
                                       "none", 0.0,
                             1e-2, usual=2e-5)
    sha256: str = text("", "map: checksum of the heights, set when they are read; a file with other heights is then refused")

    def __setstate__(self, state):
        """A copy in another process brings its heights along."""
        self.__dict__.update(state)
        if "heights" in state:
            self.__dict__["heights"] = height_map.keep(self.heights)[1]

    @cached_property
    def heights(self):
        """Heights (rows, columns) of a map in the unit of its file, as when the feature was made; nan in its holes."""
        return height_map.fetch(self.file, self.sha256)[1]

    @property
    def orientation(self):
        """The :class:`tehl_taichi.scene.surface.maps.orientation.Orientation` of its file."""
        return Orientation(self.transpose, self.mirror_x, self.mirror_y)

    @property
    def raw(self):
        """Heights (points along y, along x) of a map in m as they lie in the contact, its holes filled, scaled, with the form
        that they were measured with."""
        return hole_filling.filled(self.orientation.turned(self.heights)) * (UNITS[self.unit] * self.scale)

    @property
    def holes(self):
        """Points (along y, along x) that were not measured: what passes there is filled in."""
        return self.orientation.turned(hole_filling.missing(self.heights))

    def nearest(self, x, y):
        """Its points (along y, along x) that are nearest to x, y (m, from its centre), arrays or numbers."""
        i, j = (np.clip(np.rint(at / step + (count - 1) / 2).astype(int), 0, count - 1)
                for at, step, count in zip((np.asarray(x), np.asarray(y)), self.steps, self.points))
        return j, i

    def position_in_file(self, x, y):
        """Where in its file the nearest point to x, y (m, from its centre) stands, in words; "" beyond its patch."""
        if any(abs(at) > size / 2 for at, size in zip((x, y), self.patch)):
            return ""
        nearest = self.nearest(x, y)
        row, column = self.orientation.in_file(self.heights.shape, *nearest)
        return f"row {row + 1}, column {column + 1}" + ", not measured" * bool(self.holes[nearest])

    @cached_property
    def whole_heights(self):
        """The same levelled and filtered: what passes through the contact."""
        return self.filtered(self.cutoff)

    def filtered(self, cutoff):
        """The same levelled, low-pass with that cutoff (m; 0: none). A plane that was left passes as it is, up to the rim."""
        flat = height_map.levelled(self.raw, self.level)
        if not cutoff:
            return flat
        rest = height_map.levelled(flat, "plane")
        return flat - rest + gaussian_filter.lowpass(rest, self.steps, cutoff)

    @cached_property
    def form(self):
        """The :class:`tehl_taichi.scene.surface.maps.form.SurfaceForm` that it was measured with."""
        return SurfaceForm.of(self.raw, self.steps, self.size)

    @cached_property
    def cutoffs(self):
        """{(scales, grid): cutoff that helps there}, kept by `scene.map_cutoff`, where each try is a filter."""
        return {}

    @property
    def file_steps(self):
        """(along a row of the file, from row to row): distances of its points in m."""
        return self.pixel, self.pixel_y or self.pixel

    @property
    def steps(self):
        """(along x, along y): distances of its points in m."""
        return self.orientation.swapped(self.file_steps)

    @property
    def points(self):
        """How many it has (along x, along y)."""
        return self.orientation.swapped(self.heights.shape[::-1])

    @property
    def size(self):
        """(length, width) of the whole map in m."""
        return tuple((count - 1) * step for count, step in zip(self.points, self.steps))

    @property
    def patch(self):
        """(length along x, along y) in m of the part of a map that is used."""
        length, width = self.size
        return self.extent_x or length, self.extent_y or width

    def to_rim(self, x, y):
        """(along x, along y): distances (m) of a point x, y (m, from its centre) from the rim of the patch, < 0 beyond it."""
        return tuple(size / 2 - abs(at) for size, at in zip(self.patch, (x, y)))

    @property
    def used(self):
        """What passes through the contact: the part of `whole_heights` inside the patch, faded out at its rim."""
        return self.faded(self.inside(self.whole_heights))

    def passing(self, cutoff):
        """The same with another cutoff (m; 0: none)."""
        return self.faded(self.inside(self.filtered(cutoff)))

    def faded(self, values):
        """Values (points along y, along x) of the patch, faded out at its rim."""
        y, x = ((np.arange(count) - (count - 1) / 2) * step for count, step in zip(values.shape, self.steps[::-1]))
        return values * self.kind.window(self, x, y[:, None]) if self.taper else values

    def inside(self, values):
        """The part of such an array inside the patch."""
        rows, columns = values.shape
        cut = [int((n - 1 - round(size / step)) // 2) for n, size, step in zip((columns, rows), self.patch, self.steps)]
        return values[cut[1]:rows - cut[1], cut[0]:columns - cut[0]]

    @cached_property
    def measures(self):
        """Range and rms of what passes of a map; the largest slope is that of its patch as it was measured."""
        return dataclasses.replace(Measures.of(self.used, self.steps), slope=self.unfaded.slope)

    @cached_property
    def unfaded(self):
        """Range, rms and largest slope of its patch, not faded out."""
        return Measures.of(self.inside(self.whole_heights), self.steps)


class Map(Patch):
    measured = True

    def height(self, f, x, y):
        """Levelled, linear between its points, within its patch."""
        values = f.whole_heights
        rows, columns = values.shape
        i = np.clip(x / f.steps[0] + (columns - 1) / 2, 0, columns - 1) + 0 * y
        j = np.clip(y / f.steps[1] + (rows - 1) / 2, 0, rows - 1) + 0 * x
        i0, j0 = np.minimum(i.astype(int), columns - 2), np.minimum(j.astype(int), rows - 2)
        u, v = i - i0, j - j0
        low = (1 - u) * values[j0, i0] + u * values[j0, i0 + 1]
        high = (1 - u) * values[j0 + 1, i0] + u * values[j0 + 1, i0 + 1]
        return ((1 - v) * low + v * high) * self.window(f, x, y)

    def filled(self, f, x, y):
        """Where the nearest of its points was not measured, within its patch."""
        return f.holes[f.nearest(x, y)] & (self.window(f, x, y) > 0)

    def patch(self, f):
        return f.patch

    def symmetric(self, f):
        return False

    def top(self, f):
        return f.measures.high

    def sizes(self, f):
        return {}, {}  # its own points tell

    def tidy(self, f):
        if isinstance(f.file, os.PathLike):
            object.__setattr__(f, "file", os.fspath(f.file))
        if isinstance(f.unit, str):
            object.__setattr__(f, "unit", f.unit.translate(MICRO))

    def check(self, f):
        """Read the heights, or find those of the sha256; the file's place is kept whole."""
        if f.file:
            object.__setattr__(f, "file", os.path.abspath(f.file))
        sha256, heights = height_map.fetch(f.file, f.sha256)
        object.__setattr__(f, "sha256", sha256)
        f.__dict__["heights"] = heights
        _check_keys(f)
        _check_heights(f)
        super().check(f)

    def preview(self, f, scene):
        return map_warnings.lines(f, scene)

    def doubts(self, f, scene):
        return map_warnings.doubts(f, scene)


def _check_keys(f):
    if not f.unit:
        raise SceneError(f"feature.unit is missing: shape 'map' needs the unit of the heights in its file; allowed: "
                         f"{', '.join(UNITS)} (feature.height, m per unit of the file in version 0.1.0, is not used)")
    if f.pixel == 0:
        raise SceneError("feature.pixel is missing: shape 'map' needs the distance of its points in m, as pixel = 1e-6")
    _check_spacing(f)
    if f.height not in (0, type(f).height):
        raise SceneError(f"feature.height = {f.height:g} m has no effect on a map, whose heights are in its file; allowed: 0 "
                         "or not given (feature.scale multiplies the heights)")
    object.__setattr__(f, "height", 0.0)
    for key, size, extent, step in zip(("extent_x", "extent_y"), f.size, f.patch, f.steps):
        number(f"feature.{key}", extent, "m", 3 * step, size * (1 + 1e-9))
    if f.cutoff:
        number("feature.cutoff", f.cutoff, "m", *gaussian_filter.limits(f))


def _check_spacing(f):
    """Refuse a pixel that the coordinates in the file contradict, whatever unit they have."""
    for key, step, told in zip(("pixel", "pixel_y" if f.pixel_y else "pixel"), f.file_steps, height_map.spacing(f.sha256)):
        if told is not None and not any(math.isclose(told * unit, step, rel_tol=SAME) for unit in UNITS.values()):
            raise SceneError(f"feature.{key} = {step:g} m does not match the coordinates in feature.file = {f.file!r}, which "
                             f"are {told:g} apart in {', '.join(UNITS)}")


def _check_heights(f):
    found, where = f.unfaded, f"feature.file = {f.file!r}, in {f.unit} with level = {f.level!r},"
    if found.range > MAX_RANGE:
        raise SceneError(f"{where} ranges over {found.range:.3g} m; allowed: at most {MAX_RANGE:g} m. Is feature.unit = "
                         f"{f.unit!r} right?")
    if found.slope > MAX_SLOPE:
        raise SceneError(f"{where} has slopes of {found.slope:.1f} deg; allowed: at most {MAX_SLOPE:g} deg. Are "
                         f"feature.unit = {f.unit!r} and feature.pixel = {f.pixel:g} m"
                         f"{f', feature.pixel_y = {f.pixel_y:g} m' if f.pixel_y else ''} right?")


TENT = 1 - np.abs(np.arange(33) - 16) / 16
HILL = height_map.keep(0.3 * TENT[:, None] * TENT)  # held here, so that it is known by its sha256
EXAMPLE = {"shape": "map", "sha256": HILL[0], "unit": "um", "pixel": 10e-6, "level": "none"}
MAP = Map(
    name="map", says="heights measured on a grid (CSV, NPY), fading out at the rim of the patch",
    source="the file", keys=Measured,
    uses={"height": "0 or not given", "extent_x": "0: the whole map", "extent_y": "0: the whole map", "taper": ""},
    example=EXAMPLE, checked=(share("by hand, (1 - 8.5/16)(1 - 4/16) of a hill with straight sides", 0.3515625, 85e-6, 40e-6,
                                    **EXAMPLE),))
