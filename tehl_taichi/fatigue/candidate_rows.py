"""Rows under which the worst point below the surface may lie: from a rough measure at all points and many depths.

A search of the critical planes of all points at all depths takes as long as the passage itself. The rough measure is half the
range of a shear stress over every MOMENTS-th entry: the largest of six shears, on the planes of the axes and at 45 degrees to
them. Example, a dent with a rim on 256 x 128 cells: the rows of the feature and of the worst surface point give Fi = 1.18 at
1.2 um depth; the worst point has 1.22 at 4 um, under a row 80 um away.
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from tehl_taichi.fatigue.stress.workers import WORKERS

DEPTHS = 2  # every second depth of the ladder is measured
MOMENTS = 4  # at every fourth entry
APART = 0.25  # a: least distance between two peaks of the measure
MOST = 2  # rows for each set of moments


def rows(passage, depths, moment_sets, notify=lambda done, total: None):
    """Numbers of the reader's rows through the MOST worst points, for each set of moments.

    passage: a :class:`tehl_taichi.fatigue.stress.histories.StressHistories`; depths: (n,) m, of which every DEPTHS-th is
    measured; moment_sets: sets of moments (slices or arrays of their numbers); notify: called with (done, total) depths.
    """
    some, worst = depths[::DEPTHS], [np.zeros((passage.x.size, passage.y.size)) for _ in moment_sets]
    for done, depth in enumerate(some, 1):
        for n, found in enumerate(_ranges(passage, depth, moment_sets)):
            worst[n] = np.maximum(worst[n], found * passage.strength.at(depth).share)
        notify(done, len(some))
    return list(dict.fromkeys(row + int(passage.rows.start) for found in worst for row in _peaks(passage, found)))


def _ranges(passage, depth, moment_sets):
    """The measure (moment_sets, x', rows) Pa at a depth (m)."""
    operator, entries = passage.operator(depth), np.unique(passage.entries)[::MOMENTS]
    parts = np.array_split(entries, WORKERS)
    with ThreadPoolExecutor(WORKERS) as pool:
        lows, highs = zip(*pool.map(lambda part: _extremes(passage, operator, part, moment_sets), parts))
    return 0.5 * (np.maximum.reduce(highs) - np.minimum.reduce(lows)).max(axis=1)


def _extremes(passage, operator, entries, moment_sets):
    """(smallest, largest) shears of these entries and of the unloaded state (0), each (moment_sets, shears, x', rows) Pa."""
    shape = len(moment_sets), 6, passage.x.size, passage.y.size
    low, high = np.zeros(shape), np.zeros(shape)
    counted = [set(np.arange(passage.centres.size + 1)[moments]) for moments in moment_sets]
    for entry in entries:
        shears = _shears(operator(*passage.loads(int(entry))))
        for moment in np.flatnonzero(passage.entries == entry):
            here = passage.under(shears, moment)
            for n, those in enumerate(counted):
                if moment in those:
                    np.minimum(low[n], here, out=low[n])
                    np.maximum(high[n], here, out=high[n])
    return low, high


def _shears(s):
    """Shears (columns, rows, 6) Pa on the planes of the axes, and at 45 degrees to them, of stresses {component: array}."""
    return np.stack([s["sxy"], s["sxz"], s["syz"], 0.5 * (s["sxx"] - s["szz"]), 0.5 * (s["syy"] - s["szz"]),
                     0.5 * (s["sxx"] - s["syy"])], axis=-1)


def _peaks(passage, measure):
    """Rows of the MOST highest points of a measure (x', rows), which lie APART from each other."""
    x, y, left, out = passage.x[:, None], passage.y[None, :], measure.copy(), []
    for _ in range(MOST):
        i, row = np.unravel_index(int(np.argmax(left)), left.shape)
        out.append(int(row))
        left[np.hypot(x - x[i, 0], y - y[0, row]) < APART * passage.a] = 0.0
    return out
