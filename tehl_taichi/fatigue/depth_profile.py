"""The worst depth under one row of material points: on a ladder of depths, and between its rungs.

A rung is one depth of the ladder. Stresses change smoothly with the logarithm of the depth. So the stresses between the rungs
are interpolated (cubic, four rungs), and the worst depth is refined without new stresses of the loads.
"""

from dataclasses import dataclass, replace

import numpy as np

from tehl_taichi.fatigue import findley, index_statistics, von_mises
from tehl_taichi.fatigue.stress.row_histories import histories_of
from tehl_taichi.fatigue.worst_point import WorstPoint
from tehl_taichi.values.interpolation import lagrange

RATIO = 1.5      # of the depths of neighbouring rungs
SHALLOWEST = 0.5  # cells: closer to the surface the stresses show the rectangles of the loads
DEEPEST = 0.9    # a: the smooth contact is worst at about 0.5 a
HALVINGS = 6     # of the step in log depth, from one rung: 1.5^(1/64), 0.6 % of the depth
CLOSE = 0.9      # points above this share of the worst of a rung are searched between the rungs


@dataclass(frozen=True)
class DepthProfile:
    """Results under one row: value f (depths, x') Pa of the criterion at `depths` (n,) m, the worst point of all depths, the
    largest von Mises stress (None if the passage does not search it), and value (depths, points) Pa at the depths of statistics
    of the points that count (None if none do)."""

    depths: np.ndarray
    f: np.ndarray
    worst: WorstPoint
    mises: von_mises.VonMisesPeak | None
    counted: np.ndarray | None = None


def ladder(passage):
    """Depths (n,) m to search, from half a cell to 0.9 a or to the passage's `deepest`.

    With a fine window: the depths of the run without it, and shallower ones down to half a fine cell.
    """
    factor = round(passage.run_dx / passage.dx)
    first, last = SHALLOWEST * passage.run_dx, DEEPEST * passage.a
    count = max(5, int(np.ceil(np.log(last / first) / np.log(RATIO))) + 1)
    depths = np.geomspace(first, last, count)
    more = int(np.log(factor) / np.log(depths[1] / depths[0]) + 1e-9)
    shallower = depths[0] * (depths[0] / depths[1]) ** np.arange(more, 0, -1.0)
    return np.concatenate([shallower, depths[depths <= passage.deepest]])


def profiles(passage, rows, moment_sets=(slice(None),), notify=lambda done, total: None, counted=None):
    """List of the :class:`DepthProfile` under each row and for each set of moments (all sets of one row are neighbours).

    passage: a :class:`tehl_taichi.fatigue.stress.histories.StressHistories`; rows: numbers of rows of its reader; moment_sets:
    sets of moments (slices or arrays of their numbers); notify: called with (done, total) parts of the stresses, then of the
    searches; counted: result of :func:`tehl_taichi.fatigue.index_statistics.points_below`, for statistics of the first set.
    """
    depths, found = ladder(passage), []
    kinds = [(row, False) for row in rows]
    for n, (row, histories) in enumerate(zip(rows, histories_of(passage, depths, kinds, notify)), 1):
        first, *others = _profiles(passage, depths, histories, moment_sets, row)
        if counted and row in counted:
            first = replace(first, counted=_counted(passage, depths, histories[:, counted[row]][:, :, moment_sets[0]]))
        found += [first, *others]
        notify(n, len(kinds))
    return found


def _counted(passage, rungs, histories):
    """Values (depths, points) Pa at the depths of statistics; histories (rungs, points, moments, 6) Pa."""
    depths, logs = index_statistics.depths(passage, rungs), np.log(rungs)
    stress = np.stack([_between(passage.strength, logs, histories, np.log(depth)) for depth in depths])
    return _of_planes(passage, depths, stress)[0].reshape(stress.shape[:2])


def _profiles(passage, depths, histories, moment_sets, row):
    """The DepthProfile of each set of moments.

    A set that is part of the first one keeps the first one's planes where it reaches the same value on them.
    """
    found, all_, known = [], np.arange(histories.shape[2]), None
    first = all_[moment_sets[0]]
    for moments in moment_sets:
        some, fewer = histories[:, :, moments], np.isin(all_[moments], first).all()
        searched = _searched(passage, depths, some, known if fewer else None)
        known = known if found else searched
        found.append(_profile(passage, depths, some, searched[0].reshape(some.shape[:2]), row))
    return found


def _searched(passage, depths, histories, known):
    """The result of :func:`_of_planes` for the rungs; known: as there."""
    # the worst point has the largest f only if all depths have one limit
    worst = passage.sought.brief and len(set(passage.strength.shares(depths))) == 1
    return _of_planes(passage, depths, histories, known=known, worst=worst)


def _of_planes(passage, depths, histories, known=None, worst=False):
    """(f, normals) of histories (depths, x', moments, 6) Pa, each (depths * x', ...): one search if all depths have one kappa,
    else one per depth. known, worst: see :func:`tehl_taichi.fatigue.findley.search`."""
    kappas, criterion = passage.strength.kappas(depths), passage.scene.fatigue.criterion
    each, points = histories.shape[1], histories.reshape(-1, *histories.shape[2:])
    if len(set(kappas)) == 1:
        return findley.search(points, kappas[0], criterion=criterion, known=known, worst=worst)
    parts = [slice(n * each, (n + 1) * each) for n in range(len(kappas))]
    found = [findley.search(points[part], kappa, criterion=criterion, known=known and [values[part] for values in known])
             for part, kappa in zip(parts, kappas)]
    return tuple(np.concatenate(values) for values in zip(*found))


def of_row(passage, depths, histories, row):
    """The DepthProfile of histories (depths, x', moments, 6) Pa under one row (its number) of the reader, for all moments."""
    return _profiles(passage, depths, histories, (slice(None),), row)[0]


def _profile(passage, depths, histories, f, row):
    """The DepthProfile of histories (depths, x', moments, 6) Pa whose values f (depths, x') Pa are known."""
    logs, y, strength = np.log(depths), float(passage.reader.y[row]), passage.strength

    def search(stress, depths):
        f, normals = _of_planes(passage, depths, stress)
        found, normals = f.reshape(stress.shape[:2]), normals.reshape(*stress.shape[:2], 3)
        return found * np.array(strength.shares(depths))[:, None], found, normals

    compared = f * np.array(strength.shares(depths))[:, None]
    depth, point, *rest = _refined(strength, logs, histories, compared, search)
    worst = WorstPoint(depth, float(passage.x[point]), y, *rest, strength.at(depth))
    return DepthProfile(depths, f, worst, _mises(passage, logs, histories, y) if passage.steel else None)


def _mises(passage, logs, histories, y):
    """The VonMisesPeak of histories (depths, x', moments, 6) Pa under the row at y (m): at the depth where the stress is
    closest to the yield stress."""
    share = von_mises.share_of(passage.strength)
    shares = np.array([share(float(np.exp(log))) for log in logs])[:, None]
    values = np.stack([von_mises.largest(of_depth) for of_depth in histories]) * shares

    def search(stress, depths):
        found = np.stack([von_mises.largest(of_depth) for of_depth in stress])
        return found * np.array([share(depth) for depth in depths])[:, None], found, found

    depth, point, value, *_ = _refined(passage.strength, logs, histories, values, search)
    return von_mises.VonMisesPeak(value, depth, float(passage.x[point]), y)


def _refined(strength, logs, histories, values, search):
    """Refine the depth of the largest of `values` (depths, x') between the rungs, by halving a step in log depth.

    search(stress, depths) returns for histories (depths, points, moments, 6) Pa at some depths (m): the numbers to compare, the
    values and further results, each (depths, points, ...). Returns (depth, number of the point, value, its history, its further
    result).
    """
    best = int(np.argmax(values.max(axis=1)))
    follow = np.flatnonzero(values[best] >= CLOSE * values[best].max())

    def at(*some):
        """The worst point at each of some log depths, searched at once."""
        stress = np.stack([_between(strength, logs, histories[:, follow], log) for log in some])
        found = zip(*search(stress, [float(np.exp(log)) for log in some]), stress)
        return [_top(log, follow, *one) for log, one in zip(some, found)]

    (top,), step = at(logs[best]), logs[1] - logs[0]
    for _ in range(HALVINGS):
        step *= 0.5
        sides = at(*(log for log in (top[1] - step, top[1] + step) if logs[0] <= log <= logs[-1]))
        top = max([top, *sides], key=lambda found: found[0])
    _, log, point, value, stress, more = top
    return float(np.exp(log)), point, value, stress, more


def _top(log, follow, compared, found, more, stress):
    """(number to compare, log depth, number of the point, value, history, further result) of the worst of `follow`."""
    top = int(np.argmax(compared))
    return float(compared[top]), log, int(follow[top]), float(found[top]), stress[top], more[top]


def _between(strength, logs, histories, log):
    """Histories (points, moments, 6) Pa at the depth exp(log) m: cubic through the four nearest rungs.

    A residual stress that varies with depth is not interpolated but taken at this depth.
    """
    first = int(np.clip(np.searchsorted(logs, log) - 2, 0, logs.size - 4))
    weights = lagrange(logs[first : first + 4], log)
    out = np.tensordot(weights, histories[first : first + 4], axes=1)
    if strength.varies_in_residual:  # a cubic cannot follow its corners
        here, rungs = strength.residual(np.exp(log)), strength.residual(np.exp(logs[first : first + 4]))
        for n, (there, those) in enumerate(zip(here, rungs)):
            out[..., n] += np.dot(weights, there - those + np.zeros(4))
    return out
