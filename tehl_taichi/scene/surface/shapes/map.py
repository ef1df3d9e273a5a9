"""Heights measured on a grid."""

import math
import os

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.maps import gaussian_filter, height_map, map_warnings, part_choice, stated_keys
from tehl_taichi.scene.surface.maps.length_units import MICRO, UNITS
from tehl_taichi.scene.surface.maps.measured import Measured
from tehl_taichi.scene.surface.maps.refusals import HeightsRefused, KeyMissing
from tehl_taichi.scene.surface.shape import share
from tehl_taichi.scene.surface.shapes.patch import Patch
from tehl_taichi.values.checks import number

MAX_RANGE, MAX_SLOPE = 1e-4, 45.0  # m, degrees, of a map: beyond them no film, or a wrong unit or pixel


class Map(Patch):
    measured = rough = True
    lies_name = "turned"  # heading of what `lies` says

    def height(self, f, x, y):
        """Levelled heights, linear between the points, within the patch."""
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
        """Mask: the nearest point was not measured, within the patch."""
        return f.holes[f.nearest(x, y)] & (self.window(f, x, y) > 0)

    def patch(self, f):
        return tuple(extent or size for extent, size in zip((f.extent_x, f.extent_y), f.size))

    def finest(self, f):
        """Distances (along x, along y) of points that resolve the map; inf along an axis without variation."""
        return tuple(step if count > 1 else math.inf for step, count in zip(f.steps, f.points))

    def across(self, f):
        """Whether the rows of the file lie along y."""
        return f.transpose

    def other_lay(self, f):
        """Text: the key that turns its x to y."""
        return f"feature.transpose = {str(not f.transpose).lower()}"

    def place_words(self, row, column):
        """Row and column of a point in its file, as text."""
        return f"row {row}, column {column}"

    def lies(self, f):
        """Description of the turns of the map."""
        return f.orientation.says

    def points_words(self, f):
        """Number of points as text, along x first."""
        return " x ".join(map(str, f.points)) + " points"

    def symmetric(self, f):
        return False

    def top(self, f):
        return f.measures.high

    def sizes(self, f):
        return {}, {}  # its own points show it

    def tidy(self, f):
        if isinstance(f.file, os.PathLike):
            object.__setattr__(f, "file", os.fspath(f.file))
        if isinstance(f.unit, str):
            object.__setattr__(f, "unit", f.unit.translate(MICRO))

    def check(self, f):
        """Read the heights, or find those of the sha256; the path of the file becomes absolute."""
        if f.file:
            object.__setattr__(f, "file", os.path.abspath(f.file))
        sha256, heights = height_map.fetch(f.file, f.sha256)
        object.__setattr__(f, "sha256", sha256)
        f.__dict__["heights"] = heights
        self.check_rows(f)
        stated_keys.fill_in(f)
        _check_keys(f)
        _check_heights(f)
        super().check(f)

    def check_rows(self, f):
        """Refuse heights of a line profile."""
        if height_map.is_profile(f.heights):
            raise SceneError(f"{height_map.named(f)} is a line profile of {f.heights.size} heights; set feature.shape = "
                             "'profile', and feature.lay where its marks lie along x")

    def preview(self, f, scene):
        return map_warnings.lines(f, scene)

    def doubts(self, f, scene):
        return map_warnings.doubts(f, scene)


def _check_keys(f):
    if not f.unit:
        raise KeyMissing(f"feature.unit is missing: shape {f.shape!r} needs the unit of the heights in its file; allowed: "
                         f"{', '.join(UNITS)} (feature.height, m per unit of the file in version 0.1.0, is not used)")
    if f.pixel == 0:
        raise KeyMissing(f"feature.pixel is missing: shape {f.shape!r} needs the distance of its points in m, as pixel = "
                         f"1e-6{stated_keys.pixel_hint(f)}")
    if f.height not in (0, type(f).height):
        raise SceneError(f"feature.height = {f.height:g} m has no effect on a {f.shape}, whose heights are in its file; "
                         "allowed: 0 or not given (feature.scale multiplies the heights)")
    object.__setattr__(f, "height", 0.0)
    for key, size, extent, step, count in zip(("extent_x", "extent_y"), f.size, f.patch, f.steps, f.points):
        if count > 1:
            number(f"feature.{key}", extent, "m", 3 * step, size * (1 + 1e-9))
            _check_offset(f, key.replace("extent", "offset"), size - extent)
    if f.cutoff:
        number("feature.cutoff", f.cutoff, "m", *gaussian_filter.limits(f))


def _check_offset(f, key, room):
    """Refuse a part that extends beyond the heights; room: size of the heights minus that of the part, m."""
    if abs(getattr(f, key)) > room / 2 + 1e-9:
        raise SceneError(f"feature.{key} = {getattr(f, key):g} m moves the part beyond the heights of the file; allowed: at "
                         f"most {max(room, 0.0) / 2:.4g} m to each side (feature.{key.replace('offset', 'extent')} makes the "
                         "part smaller)")


def _check_heights(f):
    part_choice.check(f)
    found, where = f.unfaded, f"{height_map.named(f)}, in {f.unit} with level = {f.level!r},"
    if found.range > MAX_RANGE:
        raise HeightsRefused(f"{where} ranges over {found.range:.3g} m; allowed: at most {MAX_RANGE:g} m. Is feature.unit = "
                             f"{f.unit!r} right?")
    if found.slope > MAX_SLOPE:
        raise HeightsRefused(f"{where} has slopes of {found.slope:.1f} deg; allowed: at most {MAX_SLOPE:g} deg. Are "
                             f"feature.unit = {f.unit!r} and feature.pixel = {f.pixel:g} m"
                             f"{f', feature.pixel_y = {f.pixel_y:g} m' if f.pixel_y else ''} right? If so, set feature.cutoff, "
                             "or use another part (feature.offset_x, extent_x ...)")


TENT = 1 - np.abs(np.arange(33) - 16) / 16
HILL = height_map.keep(0.3 * TENT[:, None] * TENT)  # held here, so that it is known by its sha256
EXAMPLE = {"shape": "map", "sha256": HILL[0], "unit": "um", "pixel": 10e-6, "level": "none"}
MAP = Map(
    name="map", says="heights measured on a grid (CSV, NPY), fading out at the rim of the patch",
    source="the file", keys=Measured,
    uses={"height": "0 or not given", "extent_x": "0: the whole map", "extent_y": "0: the whole map", "taper": ""},
    example=EXAMPLE, checked=(share("by hand, (1 - 8.5/16)(1 - 4/16) of a hill with straight sides", 0.3515625, 85e-6, 40e-6,
                                    **EXAMPLE),))
