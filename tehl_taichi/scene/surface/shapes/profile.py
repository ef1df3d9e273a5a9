"""A line profile, measured by a stylus or cut from a map: heights over one axis, constant along the other."""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.maps import height_map
from tehl_taichi.scene.surface.maps.height_map import ROWS
from tehl_taichi.scene.surface.shape import Shape, share
from tehl_taichi.scene.surface.shapes.map import EXAMPLE as MAP_EXAMPLE
from tehl_taichi.scene.surface.shapes.map import TENT, Map
from tehl_taichi.values.quantity import choice

LAYS = {"transverse": "heights over x, the rolling direction, constant along y", "longitudinal": "heights over y, constant "
                                                                                                 "along x"}


@dataclass(frozen=True)
class Lay:
    """Key of line profiles only."""

    lay: str = choice("transverse", f"profile: how the marks of the surface lie; {'; '.join(map(': '.join, LAYS.items()))}",
                      tuple(LAYS))


class Profile(Map):
    lies_name = "lay"

    def height(self, f, x, y):
        """Levelled heights, linear between the points, within the patch."""
        at, axis = (y, 1) if self.across(f) else (x, 0)
        values = f.whole_heights.ravel()
        places = (np.arange(values.size) - (values.size - 1) / 2) * f.steps[axis]
        return np.interp(at, places, values) * self.window(f, x, y)

    def across(self, f):
        return f.lay == "longitudinal"

    def patch(self, f):
        """Size (along x, along y) of the patch; by default a profile along x has no end along y, one along y is as long as
        wide.
        """
        length = max(f.size)
        return f.extent_x or length, f.extent_y or (length if self.across(f) else math.inf)

    def transverse(self, f):
        return not self.across(f) and f.extent_y == 0

    def symmetric(self, f):
        return Shape.symmetric(self, f) if not self.across(f) else False

    def other_lay(self, f):
        return f"feature.lay = {next(lay for lay in LAYS if lay != f.lay)!r}"

    def idle(self, f):
        name = "x" if self.across(f) else "y"
        return dict.fromkeys((f"mirror_{name}", f"offset_{name}"), f"a {f.lay} profile does not vary along {name}")

    def place_words(self, row, column):
        return f"point {column}"

    def lies(self, f):
        reversed_ = ", reversed" if (f.mirror_y if self.across(f) else f.mirror_x) else ""
        return f"{f.lay} ({LAYS[f.lay]}){reversed_}"

    def points_words(self, f):
        return f"{max(f.points)} points"

    def check_rows(self, f):
        if f.level == ROWS:
            raise SceneError("feature.level = 'rows' needs shape = 'map': a line profile has no rows")
        if not height_map.is_profile(f.heights):
            rows, columns = f.heights.shape
            raise SceneError(f"{height_map.named(f)} has {rows} x {columns} heights, no line profile; set feature.shape = "
                             "'map'")


HELD = height_map.keep(0.3 * TENT[None])  # held here, so that it is known by its sha256
EXAMPLE = {**MAP_EXAMPLE, "shape": "profile", "sha256": HELD[0]}
ANY = dict.fromkeys(("file", "unit", "scale", "pixel", "mirror_x", "mirror_y", "level", "cutoff", "offset_x", "offset_y",
                     "sha256"), "")
PROFILE = Profile(
    name="profile", says="heights measured along a line, constant across it (stylus profiles)", source="the file", keys=Lay,
    uses={**ANY, "height": "0 or not given", "extent_x": "0: the whole profile", "extent_y": "0: no end; longitudinal: the "
                                                                                             "whole profile", "taper": ""},
    example=EXAMPLE, checked=(share("by hand, 1 - 8.5/16 of a hill with straight sides", 0.46875, 85e-6, 0.7e-3, **EXAMPLE),
                              share("over y, where its marks lie along x", 0.75, 30e-6, 40e-6, lay="longitudinal", **EXAMPLE)))
