"""Index of the points that count below rows of a rough surface that are spread evenly over it: a sample of all its points.

Rows below which the worst point is sought are no sample: of cosines in y the row of the feature is a crest of all of them.
"""

import numpy as np

from tehl_taichi.fatigue import findley
from tehl_taichi.fatigue.stress.row_histories import histories_of

ROWS = 8  # at most
AT_ONCE = 2  # rows whose histories are held together


def spread(counts):
    """Numbers of at most ROWS rows, spread evenly over those with points that count; counts (x', rows): their weights."""
    rows = np.flatnonzero(counts.any(axis=0))
    some = min(ROWS, rows.size)
    return rows[((np.arange(some) + 0.5) * rows.size / some).astype(int)]


def indices(passage, depths, counts):
    """(number of rows, index (depths, points), weights (points,)) of the points that count below rows :func:`spread` evenly.

    passage: a :class:`tehl_taichi.fatigue.stress.histories.StressHistories`; depths: (n,) m, increasing; counts: as for
    :func:`spread`.
    """
    rows, out, first = spread(counts), [], int(passage.rows.start)
    for some in np.array_split(rows, -(-rows.size // AT_ONCE)):
        found = histories_of(passage, depths, [(first + int(row), False) for row in some])
        out += [_indices(passage, depths, one[:, counts[:, row] > 0]) for row, one in zip(some, found)]
    each = counts[:, rows].T
    return rows.size, np.concatenate(out, axis=1), each[each > 0]


def _indices(passage, depths, histories):
    """Indices (depths, points) of histories (depths, points, moments, 6) Pa."""
    places = [passage.strength.at(depth) for depth in depths]
    return np.stack([findley.search(history, local.kappa, criterion=local.criterion)[0] / local.endurance
                     for history, local in zip(histories, places)])
