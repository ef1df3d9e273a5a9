"""Whether features find room in the gap at the ends of the grid, where they come in and leave."""

from tehl_taichi.scene import hertz
from tehl_taichi.scene.scales import Scales

FARTHEST = 9.5  # half-widths to which a grid may well reach


def warnings(scene):
    """Features higher than the gap that the dry contact leaves at an end of the grid; the film adds to it."""
    s = Scales.of(scene)
    gap, top = hertz.line_gap if s.line else hertz.point_gap, max((f.top for f in scene.features), default=0.0)
    for key, end in (("x_min", scene.grid.x_min), ("x_max", scene.grid.x_max)):
        room = gap(abs(end)) * s.h
        if scene.transient and top > room:
            need = 1.05 * hertz.gap_reaches(top / s.h, gap)
            farther = f"; grid.{key} = {need if end > 0 else -need:.2g} gives it room" if need < FARTHEST else ""
            yield (f"a feature of {top:.3g} m passes grid.{key} = {end:g} a, where the dry contact leaves {room:.3g} m: unless "
                   f"the film adds the rest, the run ends there{farther}")
