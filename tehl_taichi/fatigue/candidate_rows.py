"""Rows under which the body may be worst loaded at some depth: from a rough measure at all points and many depths.

The critical planes of all points at all depths would take as long as a passage. What one place is worse than another shows in a
few stresses already: half of what each shear ranges over, in the planes of the axes and at 45 degrees to them, at every few
moments. A dent with a rim (256 x 128 cells): from the rows of feature and surface alone Fi = 1.18 at 1.2 um, 1.22 at 4 um 80 um
away from them.
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from tehl_taichi.fatigue.stress.workers import WORKERS

DEPTHS = 2  # every so many rungs of the ladder of depths
MOMENTS = 4  # and every so many entries
APART = 0.25  # a: other peaks of the measure lie that far apart
MOST = 2  # rows of each set of moments


def rows(passage, depths, windows, notify=lambda done, total: None):
    """Numbers (of rows of the reader) of the MOST worst places of each of `windows`: moments that count.

    passage: a :class:`tehl_taichi.fatigue.stress.histories.StressHistories`; depths: m, of which every DEPTHS-th is looked at.
    notify: called with (done, total) depths.
    """
    some, worst = depths[::DEPTHS], [np.zeros((passage.x.size, passage.y.size)) for _ in windows]
    for done, depth in enumerate(some, 1):
        for n, found in enumerate(_ranges(passage, depth, windows)):
            worst[n] = np.maximum(worst[n], found * passage.strength.at(depth).share)
        notify(done, len(some))
    return list(dict.fromkeys(row + int(passage.rows.start) for found in worst for row in _peaks(passage, found)))


def _ranges(passage, depth, windows):
    """The measure (windows, x', rows) at a depth."""
    operator, entries = passage.operator(depth), np.unique(passage.entries)[::MOMENTS]
    parts = np.array_split(entries, WORKERS)
    with ThreadPoolExecutor(WORKERS) as pool:
        lows, highs = zip(*pool.map(lambda part: _extremes(passage, operator, part, windows), parts))
    return 0.5 * (np.maximum.reduce(highs) - np.minimum.reduce(lows)).max(axis=1)


def _extremes(passage, operator, entries, windows):
    """(least, most), each (windows, shears, x', rows): of the body's shears at these entries, and unloaded."""
    shape = len(windows), 6, passage.x.size, passage.y.size
    low, high = np.zeros(shape), np.zeros(shape)
    counted = [set(np.arange(passage.centres.size + 1)[moments]) for moments in windows]
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
    """(columns, rows, 6): in the planes of the axes, and at 45 degrees to them."""
    return np.stack([s["sxy"], s["sxz"], s["syz"], 0.5 * (s["sxx"] - s["szz"]), 0.5 * (s["syy"] - s["szz"]),
                     0.5 * (s["sxx"] - s["syy"])], axis=-1)


def _peaks(passage, measure):
    """Rows of the highest places, APART from each other."""
    x, y, left, out = passage.x[:, None], passage.y[None, :], measure.copy(), []
    for _ in range(MOST):
        i, row = np.unravel_index(int(np.argmax(left)), left.shape)
        out.append(int(row))
        left[np.hypot(x - x[i, 0], y - y[0, row]) < APART * passage.a] = 0.0
    return out
