"""Points of a body that are searched again where a run has a fine window: those that the run found badly loaded."""

import numpy as np

from tehl_taichi.scene.scales import Scales

SURFACE, BELOW = 0.7, 0.9  # of the largest stress there, from which a point counts; below, the contact alone has much of it
BESIDE = 0.06  # a, around these points
KEPT = "statistics", "stressed"  # of the summary, which need all points


def ends(scene, found):
    """{surface: ((x' from, to), (y from, to)) m} of the points to search; found: the SearchResult of the run alone. Of rough
    surfaces all, {}."""
    return {} if found.numbers.get("rough") else {name: _of(one, Scales.of(scene).a) for name, one in found.by_surface.items()}


def _of(found, a):
    x, y = np.asarray(found.feature_frame_x), np.asarray(found.feature_frame_y)
    columns, rows = np.nonzero(found.findley_stress >= SURFACE * found.findley_stress.max())
    places = [x[columns]]
    if found.findley_stress_under_row is not None:
        under = found.findley_stress_under_row[1:]
        places.append(x[np.nonzero((under >= BELOW * under.max()).any(axis=0))])
    return _around(np.concatenate(places), x, BESIDE * a), _around(y[rows], y, BESIDE * a)


def _around(some, places, side):
    """From where to where these lie, with `side` more; without an end where that is beyond all places."""
    low, high = float(some.min() - side), float(some.max() + side)
    return (low if low > places.min() else -np.inf), (high if high < places.max() else np.inf)


def at_an_end(found, ends_of, cell):
    """Whether the worst point of a body, at the surface or below it, lies at an end of what was searched of it, so that a worse
    one may lie beyond; found: SearchResult; ends_of: of :func:`ends`; cell: m."""
    for name, one in found.by_surface.items():
        points = [one.numbers, *([one.numbers["below"]] if "below" in one.numbers else [])]
        if name in ends_of and any(_near(ends_of[name], part, cell) for part in points):
            return True
    return False


def _near(box, part, cell):
    """Whether a point lies within a cell of an end of a box."""
    (left, right), (low, high) = box
    x, y = part["x_m"], part["y_m"]
    return min(x - left, right - x, y - low, high - y) < cell


def completed(summaries, run):
    """{surface: summary} of a search of some points with what needs all of them from that of the run, {surface: summary}."""
    return {name: _with(one, run.get(name, {})) for name, one in summaries.items()}


def _with(summary, run):
    out = {**summary, **{key: run[key] for key in KEPT if key in run}}
    if "below" in summary and "statistics" in run.get("below", {}):
        out["below"] = {**summary["below"], "statistics": run["below"]["statistics"]}
    return out
