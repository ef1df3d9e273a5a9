"""Choice of the points that are searched again with a fine window: those with a large stress in the run without it."""

from dataclasses import replace

import numpy as np

from tehl_taichi.fatigue.depth_profile import RATIO
from tehl_taichi.fatigue.sought import Box
from tehl_taichi.scene import zoom_room
from tehl_taichi.scene.scales import Scales

# share of the largest stress at the surface and below it from which a point is searched again. Below, the smooth contact alone
# causes a large part of the stress
SURFACE, BELOW = 0.7, 0.9
EVERYWHERE = -np.inf, np.inf
BESIDE = 0.06  # a: distance searched around these points
LEAST = 5  # least number of depths: stresses between them are interpolated by cubics
KEPT = "statistics", "stressed"  # parts of the summary of the run that are kept, since they need all points


def ends(scene, found):
    """{surface: Box} of the points to search again; {}: all (rough surfaces).

    With several windows those of all places: the run may see too little of the feature that is worst with its window.
    found: SearchResult of the run without a window.
    """
    if found.numbers.get("rough"):
        return {}
    deepest = max(_deepest(one) for one in found.by_surface.values())
    if zoom_room.followed(scene)[1:]:
        return dict.fromkeys(found.by_surface, Box(EVERYWHERE, EVERYWHERE, (0.0, deepest)))
    return {name: _of(one, Scales.of(scene).a, deepest) for name, one in found.by_surface.items()}


def under_worst(boxes, finest):
    """The `boxes` {surface: Box} for a search with a coarser window: below the surface, only the rows with a worst point of the
    finer window (`finest`, its SearchResult) are searched."""
    return {name: box._replace(chosen_y=_rows_of_worst(finest.by_surface[name].numbers)) for name, box in boxes.items()}


def _rows_of_worst(numbers):
    """Positions y (m) of the worst points below the surface: of the whole passage, its resolved part, and averaged stresses."""
    parts = numbers, numbers.get("resolved", {}), numbers.get("averaged", {})
    return tuple(dict.fromkeys(part["below"]["y_m"] for part in parts if "below" in part)) or None


def _deepest(found):
    """Depth (m) down to which a window may matter: below it the stress of the run is much less than the largest one."""
    if found.findley_stress_under_row is None:
        return np.inf
    depths, under = found.row_depths, found.index("findley_stress_under_row").max(axis=1)
    last = max(np.flatnonzero(under >= BELOW * under.max())[-1], LEAST,
               np.searchsorted(depths, max(_worst_depths(found.numbers))))
    return float(depths[last + 1] * (1 + 1e-9)) if last + 1 < depths.size else np.inf


def _worst_depths(numbers):
    """Depths (m) of the worst points of a search."""
    wide, steel = numbers.get("averaged", {}).get("below", {}), numbers.get("von_mises", {})
    return [part.get("depth_m", 0.0) for part in (numbers.get("below", {}), wide, steel)]


def _of(found, a, deepest):
    """Box of one body down to the depth `deepest` (m); a: half-width, m."""
    x, y = np.asarray(found.feature_frame_x), np.asarray(found.feature_frame_y)
    columns, rows = np.nonzero(found.findley_stress >= SURFACE * found.findley_stress.max())
    places = [x[columns]]
    if found.findley_stress_under_row is not None:
        under = found.findley_stress_under_row[1:]
        places.append(x[np.nonzero((under >= BELOW * under.max()).any(axis=0))])
    side = BESIDE * a
    return Box(_around(np.concatenate(places), x, side), _around(y[rows], y, side), (0.0, deepest))


def _around(some, places, side):
    """(from, to) of the positions `some`, with a margin `side` (m); infinite if that is beyond all `places`."""
    low, high = float(some.min() - side), float(some.max() + side)
    return (low if low > places.min() else -np.inf), (high if high < places.max() else np.inf)


def at_an_end(found, ends_of, cell):
    """Whether the worst point of a body lies at an end of the searched part, so that a worse one may lie beyond it.

    found: SearchResult of the searched part; ends_of: result of :func:`ends`; cell: size of a fine cell, m.
    """
    for name, one in found.by_surface.items():
        points = [one.numbers, *([one.numbers["below"]] if "below" in one.numbers else [])]
        if name in ends_of and (any(_near(ends_of[name], part, cell) for part in points)
                                or max(_worst_depths(one.numbers)) * RATIO > ends_of[name][2][1]):
            return True
    return False


def _near(box, part, cell):
    """Whether a point lies within a cell of a side of the box (its lower end is not checked)."""
    (left, right), (low, high), *_ = box
    x, y = part["x_m"], part["y_m"]
    return min(x - left, right - x, y - low, high - y) < cell


def deeper(found, run):
    """The SearchResult `found` of some points, with the stresses of the run (SearchResult) at the depths below them, and with
    its smooth contact."""
    others = run.by_surface
    return found.joined([_of_run(one, others[name]) for name, one in found.by_surface.items()])


def _of_run(found, run):
    result = _deeper(found, run)
    if run.findley_stress_contact_alone is None or result.findley_stress_under_row is None:
        return result
    smooth = np.interp(result.row_depths, run.row_depths, run.findley_stress_contact_alone)
    return replace(result, findley_stress_contact_alone=smooth)


def _deeper(found, run):
    more = None if found.findley_stress_under_row is None else run.row_depths > found.row_depths[-1] * (1 + 1e-6)
    if more is None or not more.any():
        return found
    depths = "fatigue_depth" if found.under_row_depth is None else "under_row_depth"

    def under(one, other):
        rows = [np.interp(found.feature_frame_x, run.feature_frame_x, row) for row in other.findley_stress_under_row[more]]
        return np.concatenate([one.findley_stress_under_row, rows])

    changes = {depths: np.append(found.row_depths, run.row_depths[more]), "findley_stress_under_row": under(found, run)}
    if found.limit_under_row is not None:
        changes["limit_under_row"] = np.append(found.limit_under_row, run.limit_under_row[more])
    if part := found.resolved:
        changes["resolved"] = replace(part, findley_stress_under_row=under(part, run.resolved or run))
    return replace(found, **changes)


def completed(summaries, run):
    """{surface: summary} of a search of some points, with the parts KEPT from the {surface: summary} of the run."""
    return {name: _with(one, run.get(name, {})) for name, one in summaries.items()}


def _with(summary, run):
    out = {**summary, **{key: run[key] for key in KEPT if key in run}}
    if "below" in summary:
        out["below"] = _with_below(summary["below"], run.get("below", {}))
    return out


def _with_below(deep, run):
    out = {**deep, **({"statistics": run["statistics"]} if "statistics" in run else {})}
    if "searched_m" in deep and "searched_m" in run:
        out["searched_m"] = [deep["searched_m"][0], run["searched_m"][1]]
    return out
