"""The worst depth below the surface: under one row of material points, from a ladder of depths and between its rungs.

Stresses change smoothly with the logarithm of the depth, so those between the rungs are interpolated (four rungs, cubic) and
the depth is refined without going back to the loads.
"""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import findley, von_mises
from tehl_taichi.fatigue.stress.averaging import has_window
from tehl_taichi.fatigue.stress.row_histories import histories_of
from tehl_taichi.fatigue.worst_point import WorstPoint
from tehl_taichi.values.interpolation import lagrange

RATIO = 1.5      # of neighbouring depths
SHALLOWEST = 0.5  # cells: nearer to the surface the rectangles of the loads are seen
DEEPEST = 0.9    # a: the contact alone is worst at about a half
HALVINGS = 6     # of the step in log depth, from a rung: 1.5^(1/64), 0.6 %
CLOSE = 0.9      # points within this of the worst of a rung are followed between the rungs


@dataclass(frozen=True)
class Profile:
    """Findley stress f (depths, x') Pa at depths (m), the worst point of all depths, the largest von Mises stress
    (if wanted)."""

    depths: np.ndarray
    f: np.ndarray
    worst: WorstPoint
    mises: von_mises.VonMisesPeak | None


def ladder(passage):
    """Depths (m) searched, from half a cell to 0.9 a or the deepest of the passage; with a window those of the run and
    shallower ones."""
    factor = passage.reader.window.factor if has_window(passage.reader) else 1
    first, last = SHALLOWEST * passage.dx * factor, DEEPEST * passage.a
    count = max(5, int(np.ceil(np.log(last / first) / np.log(RATIO))) + 1)
    depths = np.geomspace(first, last, count)
    more = int(np.log(factor) / np.log(depths[1] / depths[0]) + 1e-9)
    shallower = depths[0] * (depths[0] / depths[1]) ** np.arange(more, 0, -1.0)
    return np.concatenate([shallower, depths[depths <= passage.deepest]])


def profiles(passage, rows, windows=(slice(None),), notify=lambda done, total: None):
    """:class:`Profile` of a passage under every one of these rows of its reader, for each of `windows`: moments that count.

    notify: called with (done, total) parts of the stresses, then of the searches.
    """
    depths, found = ladder(passage), []
    kinds = [(row, False) for row in rows]
    for n, (row, histories) in enumerate(zip(rows, histories_of(passage, depths, kinds, notify)), 1):
        found += _profiles(passage, depths, histories, windows, row)
        notify(n, len(kinds))
    return found


def _profiles(passage, depths, histories, windows, row):
    """The Profile of each window. Windows of some moments of the first one keep its planes where they have as much there."""
    found, all_, known = [], np.arange(histories.shape[2]), None
    first = all_[windows[0]]
    for moments in windows:
        some, fewer = histories[:, :, moments], np.isin(all_[moments], first).all()
        searched = _searched(passage, depths, some, known if fewer else None)
        known = known if found else searched
        found.append(_profile(passage, depths, some, searched[0].reshape(some.shape[:2]), row))
    return found


def _searched(passage, depths, histories, known):
    """(f, normals) of all points of histories (depths, x', moments, 6) Pa, all at once where they have one kappa; known: see
    :func:`tehl_taichi.fatigue.findley.search`."""
    kappas, criterion, strength = passage.strength.kappas(depths), passage.scene.fatigue.criterion, passage.strength
    each, points = histories.shape[1], histories.reshape(-1, *histories.shape[2:])
    if len(set(kappas)) == 1:
        worst = passage.worst and len(set(strength.shares(depths))) == 1  # else another depth may be worse by its limit
        return findley.search(points, kappas[0], criterion=criterion, known=known, worst=worst)
    parts = [slice(n * each, (n + 1) * each) for n in range(len(kappas))]
    found = [findley.search(points[part], kappa, criterion=criterion, known=known and [values[part] for values in known])
             for part, kappa in zip(parts, kappas)]
    return tuple(np.concatenate(values) for values in zip(*found))


def of_row(passage, depths, histories, row):
    """The Profile of histories (depths, x', moments, 6) Pa of the points under a row."""
    return _profiles(passage, depths, histories, (slice(None),), row)[0]


def _profile(passage, depths, histories, f, row):
    logs, y, strength = np.log(depths), float(passage.reader.y[row]), passage.strength

    def search(stress, depth):
        local = strength.at(depth)
        found, normals = findley.search(stress, local.kappa, criterion=local.criterion)
        return found * local.share, found, normals

    compared = f * np.array(strength.shares(depths))[:, None]
    depth, point, *rest = _refined(strength, logs, histories, compared, search)
    worst = WorstPoint(depth, float(passage.x[point]), y, *rest, strength.at(depth))
    return Profile(depths, f, worst, _mises(passage, logs, histories, y) if passage.steel else None)


def _mises(passage, logs, histories, y):
    """The largest von Mises stress of histories (depths, x', moments, 6) Pa of the points under the row at y (m), beside the
    yield stress of its depth."""
    share = von_mises.share_of(passage.strength)
    shares = np.array([share(float(np.exp(log))) for log in logs])[:, None]
    values = np.stack([von_mises.largest(of_depth) for of_depth in histories]) * shares

    def search(stress, depth):
        found = von_mises.largest(stress)
        return found * share(depth), found, found

    depth, point, value, *_ = _refined(passage.strength, logs, histories, values, search)
    return von_mises.VonMisesPeak(value, depth, float(passage.x[point]), y)


def _refined(strength, logs, histories, values, search):
    """(depth, point, value, stress, more) of the largest of values (depths, x'), between the rungs too: the step halved around
    the best. search(stress, depth): of histories (points, moments, 6) what is compared, the values and more of each."""
    best = int(np.argmax(values.max(axis=1)))
    follow = np.flatnonzero(values[best] >= CLOSE * values[best].max())

    def at(log):
        stress = _between(strength, logs, histories[:, follow], log)
        compared, found, more = search(stress, float(np.exp(log)))
        top = int(np.argmax(compared))
        return float(compared[top]), log, int(follow[top]), float(found[top]), stress[top], more[top]

    top, step = at(logs[best]), logs[1] - logs[0]
    for _ in range(HALVINGS):
        step *= 0.5
        sides = [at(log) for log in (top[1] - step, top[1] + step) if logs[0] <= log <= logs[-1]]
        top = max([top, *sides], key=lambda found: found[0])
    _, log, point, value, stress, more = top
    return float(np.exp(log)), point, value, stress, more


def _between(strength, logs, histories, log):
    """Histories (points, moments, 6) at the depth exp(log): the cubic through the four nearest rungs, with the residual stress
    of that depth."""
    first = int(np.clip(np.searchsorted(logs, log) - 2, 0, logs.size - 4))
    weights = lagrange(logs[first : first + 4], log)
    out = np.tensordot(weights, histories[first : first + 4], axes=1)
    if strength.varies_in_residual:  # its corners are none of a cubic
        here, rungs = strength.residual(np.exp(log)), strength.residual(np.exp(logs[first : first + 4]))
        for n, (there, those) in enumerate(zip(here, rungs)):
            out[..., n] += np.dot(weights, there - those + np.zeros(4))
    return out
