"""Worst points below rows by stresses that are computed at their depths.

Between the rungs of a ladder of depths stresses are interpolated. That finds the depth, but its error, up to 0.12 % of the
index, depends on the rungs. So the stresses are computed once more, at the depths found.
"""

from dataclasses import replace

from tehl_taichi.fatigue import findley, von_mises
from tehl_taichi.fatigue.stress.row_histories import histories_of
from tehl_taichi.fatigue.worst_point import worse

NEAR = 0.98  # points with a smaller share of the largest value cannot be the worst, and keep their interpolated stresses


def computed(passage, rows, profiles, moment_sets=(slice(None),), endless=False):
    """The `profiles` with the worst points, and the largest von Mises stresses of the first set, of computed stresses.

    rows, profiles, moment_sets: arguments and result of :func:`tehl_taichi.fatigue.depth_profile.profiles`. endless: whether
    the loads of a row continue along y for ever.
    """
    out, each = list(profiles), len(moment_sets)
    worst = {n for first in range(each) for n in _near(range(first, len(out), each), [one.worst.compared for one in out])}
    peaks = _near(range(0, len(out), each), _peaks(passage, out)) if passage.steel else set()
    for place, row in enumerate(rows):
        own = range(place * each, (place + 1) * each)
        depths = {out[n].worst.depth for n in worst & {*own}} | {out[n].mises.depth for n in peaks & {*own}}
        found = _histories(passage, row, sorted(depths), endless)
        for n, moments in zip(own, moment_sets):
            out[n] = replace(out[n], **(_worst(passage, found, out[n].worst, moments) if n in worst else {}),
                             **(_mises(passage, found, out[n].mises, moments) if n in peaks else {}))
    return out


def _near(numbers, values):
    """Numbers (of `numbers`) whose values are close to the largest."""
    top = max(values[n] for n in numbers)
    return {n for n in numbers if values[n] >= top - (1 - NEAR) * abs(top)}


def _peaks(passage, profiles):
    """Largest von Mises stress of each profile over the yield stress of its depth, times that of the surface."""
    share = von_mises.share_of(passage.strength)
    return [one.mises.value * share(one.mises.depth) for one in profiles]


def _histories(passage, row, depths, endless):
    """{depth: histories (x', moments, 6) Pa} under a row."""
    return dict(zip(depths, histories_of(passage, depths, [(row, endless)])[0])) if depths else {}


def _places(passage, point):
    """Function of the number of a point at the depth and in the row of `point`: its (depth, x, y) in m."""
    return lambda n: (point.depth, float(passage.x[n]), point.y)


def _worst(passage, found, point, moments):
    """{"worst": WorstPoint} of the computed histories `found` at the depth of `point`."""
    history, local = found[point.depth][:, moments], point.local
    f, normals = findley.search(history, local.kappa, criterion=local.criterion, worst=True)
    return {"worst": worse(None, _places(passage, point), history, f, normals, local)}


def _mises(passage, found, peak, moments):
    """{"mises": VonMisesPeak} of the computed histories `found` at the depth of `peak`."""
    return {"mises": von_mises.peak(found[peak.depth][:, moments], _places(passage, peak))}
