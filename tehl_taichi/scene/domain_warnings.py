"""Space for features in the domain: in the gap at its ends and between its sides; one proposal of a domain that fits all."""

import math

from tehl_taichi.scene import hertz, overlap, resolution
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.coded_text import Option, grid_option
from tehl_taichi.values.coded_warning import with_data

FARTHEST = 9.5  # half-widths to which a grid may well reach
AMPLE = 1.02  # of the distance at which the gap is just as high as a feature, then the next tenth of a half-width
WIDER = 1.05  # times that cells may grow with a domain before it gets more of them


def warnings(scene):
    """One sentence about features that are higher than the gap of the dry contact at an end of the grid (the film adds to it)
    or wider than the grid, with a domain that fits all of them.
    """
    reasons = [*_low_ends(scene), *_narrow(scene)] if scene.transient else []
    if reasons:
        option = domain_words(scene)
        yield with_data("; ".join([*reasons, *[f"use {option}"] * bool(option)]), option)


def domain_words(scene):
    """Options of a domain that fits the features, with cells of the present size; "" if none does."""
    ends = {key: end for key, *_, end in _low(scene)} | _sides(scene)
    if not ends or max(map(abs, ends.values())) > FARTHEST:
        return ""
    sets, grid = [f"grid.{key}={end:g}" for key, end in ends.items()], _grid(scene, ends)
    return Option(" ".join([*(f"--set {one}" for one in sets), *grid]), " and ".join([*sets, *(one.words for one in grid)]))


def _low(scene):
    """(key, end (a), gap (m), height (m) of the features there, a sufficient end) for each end of the grid where the gap is too
    low."""
    s = Scales.of(scene)
    gap = hertz.line_gap if s.line else hertz.point_gap
    for key in ("x_min", "x_max"):
        end = getattr(scene.grid, key)
        room = gap(max(abs(end), 1.0)) * s.h
        if (top := overlap.highest_at(scene, end, room)) > room:
            yield key, end, room, top, math.copysign(math.ceil(10 * AMPLE * hertz.gap_reaches(top / s.h, gap)) / 10, end)


def _low_ends(scene):
    for key, end, room, top, _ in _low(scene):
        who, passes = higher(scene, top), higher(scene, top, ("passes", "pass"))
        yield (f"{who} of {top:.3g} m {passes} grid.{key} = {end:g} a, where the dry gap is {room:.3g} m; the run stops there "
               "unless the film is thick enough")


def higher(scene, top, words=("a feature", "overlapping features")):
    """Words for the one feature, or for the features together, that reach this height (m)."""
    return words[top > max(f.top for f in scene.features)]


def _wide(scene):
    """{number: extent (m) along y} of features that the sides of the domain cut."""
    s = Scales.of(scene)
    edge = scene.grid.y_max * s.b
    reached = {n: abs(f.y) + f.reach_y for n, f in enumerate(scene.features)
               if not (f.transverse or resolution.misses_contact(f, s))}
    return {n: far for n, far in reached.items() if edge * (1 + 1e-9) < far < math.inf}


def _sides(scene):
    """{"y_max": width in b that fits all features}; {} if none is cut."""
    wide = _wide(scene)
    return {"y_max": math.ceil(10 * max(wide.values()) / Scales.of(scene).b - 1e-9) / 10} if wide else {}


def _narrow(scene):
    """Description of the feature that extends farthest beyond the sides of the domain."""
    if wide := _wide(scene):
        n = max(wide, key=wide.get)
        yield (f"{resolution.label(scene, n)} reaches to "
               f"{wide[n]:.3g} m along y, the domain to grid.y_max = {scene.grid.y_max:g} "
               f"b ({scene.grid.y_max * Scales.of(scene).b:.3g} m); heights beyond are cut off{_smaller(scene, n)}")


def _smaller(scene, n):
    """Advice how to make a patch fit into the present domain."""
    f, s = scene.features[n], Scales.of(scene)
    room = 2 * (scene.grid.y_max * s.b - abs(f.y))
    if "extent_y" not in f.kind.uses or room < s.b / 10:
        return ""
    return f" ({resolution.label(scene, n)}.extent_y = {math.floor(room * 1e6) * 1e-6:.4g} makes the patch smaller)"


def _grid(scene, ends):
    """[--grid that keeps the size of the cells in a domain with these ends]; [] if the present number suffices."""
    g = scene.grid
    x_min, x_max, y_max = (ends.get(key, getattr(g, key)) for key in ("x_min", "x_max", "y_max"))
    nx, ny = cells("nx", g.nx, (x_max - x_min) / (g.x_max - g.x_min)), cells("ny", g.ny, y_max / g.y_max)
    return [grid_option(scene, nx, ny)] if (nx, ny) != (g.nx, g.ny) else []


def cells(key, count, times):
    """Cells of the axis "nx" or "ny" if it becomes `times` as long: about as large as before, in multiples that a grid
    accepts.
    """
    multiple = resolution.kept_multiple(key, count)
    return count if 1 <= times <= WIDER else math.ceil(count * times / WIDER / multiple - 1e-9) * multiple
