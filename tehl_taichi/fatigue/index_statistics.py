"""Distribution of the index over the points of a body that features pass over; it converges where the largest index does
not.
"""

import numpy as np

from tehl_taichi.fatigue import sampled_rows
from tehl_taichi.fatigue.sought import Sought
from tehl_taichi.fatigue.stress.averaging import is_mirrored
from tehl_taichi.scene.rough_surfaces import is_rough
from tehl_taichi.values.arrays import nearest_index

QUANTILES = {"median": 0.5, "p90": 0.9, "p99": 0.99}
NUMBERS = ("share_above_1", *QUANTILES)
ALIKE = 1e-4  # of the largest index: a half domain has one of two mirrored points, a ridge one of all its rows
SAMPLE = 256  # points whose cycles are counted
DEPTHS = (0.02, 0.05, 0.1, 0.2, 0.5)  # a: the same on every grid, for error bars
SEEN = 2.0  # times the smallest searched depth, half a cell: nearer to the surface no coarser grid has a number to compare with


def weights(passage):
    """Weights (x', rows): number of surface points that each point of the window represents: 0 beside the path of the features,
    2 on a half domain. If features are smaller than a cell, all searched points count.
    """
    inside = np.zeros((passage.x.size, passage.y.size))
    for feature in passage.scene.features:
        inside[np.ix_(*_under(passage, feature))] = 1.0
    inside = inside if inside.any() else np.ones_like(inside)
    both = is_mirrored(passage.reader)
    return inside * np.where(both & (passage.y > 0), 2.0, 1.0)


def _under(passage, feature):
    """Mask (columns, rows) of points below a feature at some moment in the contact."""
    x, y = passage.x, passage.y
    ends = passage.passed(feature) or (x[0], x[-1])  # at rest: every point passes it
    across = np.full(y.size, True) if feature.transverse else np.abs(y - feature.y) <= feature.reach_y
    return (x >= min(ends) - feature.reach) & (x <= max(ends) + feature.reach), across


def statistics(Fi, counts):
    """{number: value} of NUMBERS and "points"; Fi, counts: arrays of one shape, see :func:`weights`."""
    chosen = counts > 0
    values, each = Fi[chosen], counts[chosen]
    one, of_one = _merged(values, each)
    at = (np.cumsum(of_one) - 0.5 * of_one) / each.sum()
    return {"share_above_1": float(each[values > 1].sum() / each.sum()), "points": int(values.size),
            **{name: float(np.interp(share, at, one)) for name, share in QUANTILES.items()}}


def _merged(values, each):
    """(values in ascending order, their weights); those that are alike count as one, as a point and its mirror image do."""
    _, place = np.unique(np.round(values / max(ALIKE * np.abs(values).max(), np.finfo(float).tiny)), return_inverse=True)
    weights = np.bincount(place, each)
    return np.bincount(place, values * each) / weights, weights


def exceeded(Fi, counts):
    """(values in ascending order, share of the surface above each of them)."""
    chosen = counts > 0
    order = np.argsort(Fi[chosen])
    each = counts[chosen][order]
    return Fi[chosen][order], 1 - np.cumsum(each) / each.sum()


def sample(counts):
    """Mask (x', rows) of points whose cycles are counted: at most SAMPLE of them, evenly spread."""
    points = np.flatnonzero(counts)
    out = np.zeros(counts.size, bool)
    out[points[:: max(1, -(-points.size // SAMPLE))]] = True
    return out.reshape(counts.shape)


def depths(passage, rungs):
    """The depths of statistics (m) that lie between the searched ones, `rungs`."""
    return [share * passage.a for share in DEPTHS if rungs[0] <= share * passage.a <= rungs[-1]]


def has_below(passage):
    """Whether a search has statistics below the surface, which need all points."""
    return passage.sought is not Sought.WORST and not passage.boxed


def points_below(passage):
    """{number of a row of the reader: mask of its points that count} of the rows in the middle of the features; {} where no
    statistics are wanted, or those of rows that are spread over a rough surface.

    Other rows are searched by what is worst in them, which depends on rounding.
    """
    if not has_below(passage) or passage.y.size > 1 and is_rough(passage.scene):
        return {}
    counts = weights(passage)
    middle = dict.fromkeys(nearest_index(passage.y, f.centre_y) for f in passage.scene.features)
    return {passage.rows.start + row: counts[:, row] > 0 for row in middle if counts[:, row].any()}


def below(passage, profiles, counts):
    """Statistics at DEPTHS below some rows: "by_depth", and those of the depth with the largest 99th percentile, at least one
    cell deep; "rows": number of these rows.

    profiles: list of :class:`tehl_taichi.fatigue.depth_profile.DepthProfile`. Their points count; without any, those under rows
    that are spread evenly (:mod:`tehl_taichi.fatigue.sampled_rows`).
    """
    rungs = profiles[0].depths
    at = depths(passage, rungs)
    own = [one for one in profiles if one.counted is not None]
    rows, Fi, each = _of_profiles(passage, own, at, counts) if own else sampled_rows.indices(passage, at, counts)
    out = [{"depth_m": depth, **statistics(of_depth, each)} for depth, of_depth in zip(at, Fi)]
    seen = [one for one in out if one["depth_m"] >= SEEN * rungs[0]]
    return {**max(seen or out, key=lambda one: one["p99"]), "rows": rows, "by_depth": out}


def _of_profiles(passage, profiles, depths, counts):
    """(number of rows, indices (depths, points), weights (points,)) of the points of these profiles that count."""
    limits = np.array([passage.strength.at(depth).endurance for depth in depths])[:, None]
    each = [counts[:, nearest_index(passage.y, one.worst.y)] for one in profiles]
    return len(profiles), np.concatenate([one.counted for one in profiles], axis=1) / limits, np.concatenate(
        [of_row[of_row > 0] for of_row in each])
