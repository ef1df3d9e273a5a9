"""Critical points of a run with a window, followed through all moments of the window, also between the steps of the run.

A search takes the moments of the run, one cell of the run apart. A front that is a few cells of the window wide then passes a
point between two moments: the gear's asperity at SRR -0.12 on 512x128 cells has an index over 10 um of 0.9709 and 1.2556
(bodies a and b), with every fourth moment 0.9679 and 1.2498. Which of some neighbours is the worst also depends on the moments,
so at the surface all those are followed that may be the worst.

Thermal stress changes slowly at a point, so it is interpolated between the moments of the run (with what else the history has
and its loads do not cause); but for that of a hot surface layer that is held in its plane, which follows its temperature.
"""

from dataclasses import replace

import numpy as np

from tehl_taichi.fatigue import depth_search, findley
from tehl_taichi.fatigue.layer import layer
from tehl_taichi.fatigue.sought import Box
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.stress.row_histories import histories_of
from tehl_taichi.fatigue.worst_point import worst_of
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.values.interpolation import lagrange

SAME = 1e-12  # m: moments whose features are closer to each other are one
POINTS = 4  # moments of the run that a polynomial uses


def searched(scene, passage, top, early, progress):
    """(layers, DepthResult) of a search whose :class:`tehl_taichi.fatigue.layer.Layer` `top` at the surface is known: at the
    listed depths and at the worst one, as :func:`followed` returns them.

    early: numbers of the moments that are also searched alone, or None; progress: a PassProgress, which ends here.
    """
    layers = [top, *(layer(scene, passage, depth, progress, early) for depth in scene.fatigue.listed)]
    deep = depth_search.search(scene, passage, layers, early, progress) if scene.fatigue.depths else depth_search.DepthResult()
    progress.end()
    return followed(scene, passage, layers, deep)


def followed(scene, passage, layers, deep):
    """(layers, deep) of a search with their critical points followed through all moments; the same ones without a window.

    passage: its StressHistories, whose reader has `every`, the reader of all moments, if it has moments between the steps.
    layers: list of :class:`tehl_taichi.fatigue.layer.Layer`, the surface first; deep:
    :class:`tehl_taichi.fatigue.depth_search.DepthResult`.
    """
    reader = getattr(passage.reader, "every", None)
    if reader is None:
        return layers, deep
    points = _critical(layers, deep)
    known = {id(point): new for point, new in zip(points, _at_all_moments(scene, passage, reader, points))}

    def with_new(found):
        """A part of the search with its new critical points."""
        return found and replace(found, worst=known.get(id(found.worst), found.worst))

    surface = _raised(layers[0], passage, [known[id(point)] for point in layers[0].close])
    layers = [replace(with_new(one), early=with_new(one.early)) for one in [surface, *layers[1:]]]
    plane = deep.plane and replace(with_new(deep.plane), early=with_new(deep.plane.early))
    return layers, replace(deep, profiles=[with_new(one) for one in deep.profiles], plane=plane,
                           before=[with_new(one) for one in deep.before], early_plane=with_new(deep.early_plane))


def _critical(layers, deep):
    """The critical points (each once) at the surface and below it, of all moments and of the early ones."""
    early = [one.early.worst for one in layers if one.early]
    found = [*layers[0].close, worst_of([one.worst for one in layers[1:]] + deep.worst), *early[:1],
             worst_of(early[1:] + deep.early)]
    return list({id(point): point for point in found if point}.values())


def _raised(layer, passage, points):
    """The layer with the worst of `points` (WorstPoints by all moments), and with their values f (Pa)."""
    f = layer.f.copy()
    for point in points:
        place = nearest_index(passage.x, point.x), nearest_index(passage.y, point.y)
        f[place] = max(f[place], point.f)
    return replace(layer, f=f, worst=worst_of(points), close=[])


def _at_all_moments(scene, passage, reader, points):
    """The WorstPoints `points` of a search with their histories, values and planes by all moments of `reader`."""
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    new = np.abs(centres[:, None] - passage.positions).min(axis=1) > SAME
    if not (new := new & (centres > passage.positions[0]) & (centres < passage.positions[-1])).any():
        return points
    loads = StressHistories(_of_loads(scene, passage, centres[new][0]), reader, centres, surface=passage.surface,
                            box=_box(passage, points))
    histories = _histories(scene, loads, points)
    return _searched([_with_moments(point, passage.positions, loads.positions, history)
                      for point, history in zip(points, histories)])


def _histories(scene, loads, points):
    """The history (moments + 1, 6) Pa of the loads, and of the heat of a surface layer, of each of some points; loads: their
    StressHistories."""
    depths, rows = sorted({point.depth for point in points}), sorted({_row(loads, point) for point in points})
    found = dict(zip(rows, histories_of(loads, depths, [(row, False) for row in rows])))
    if scene.has_thermal_stress and not depths[0]:
        from tehl_taichi.fatigue.stress import held_heat

        for row, held in held_heat.histories(loads, rows).items():
            found[row][0] += held
    return [found[_row(loads, point)][depths.index(point.depth), nearest_index(loads.x, point.x)] for point in points]


def _row(loads, point):
    """Number of the row of a point."""
    return nearest_index(loads.reader.y, point.y)


def _of_loads(scene, passage, start):
    """The scene without thermal stress, from POINTS steps of the run before the position `start` (m) of the feature on."""
    first = passage.positions[passage.positions < start][-POINTS:][0] / passage.a - 1e-9
    return scene.replace(**{"fatigue.thermal_stress": False, "fatigue.from_x": max(float(first), scene.fatigue.from_x)})


def _box(passage, points):
    """Box around the points."""
    def around(places, cell):
        return min(places) - cell / 2, max(places) + cell / 2

    rows = passage.reader.y
    cell = float(rows[1] - rows[0]) if len(rows) > 1 else 1.0
    return Box(around([one.x for one in points], passage.dx), around([one.y for one in points], cell))


def _with_moments(point, steps, moments, history):
    """A WorstPoint with the stress of all moments up to its last one, without a new plane.

    steps, moments: positions of the feature (m), without the unloaded moment, of the search and of the `history` (moments + 1,
    6) Pa of the loads, which begins later.
    """
    steps = steps[: len(point.stress) - 1]
    away = np.abs(moments[:, None] - steps)
    same, new = away.argmin(axis=0), np.flatnonzero((away.min(axis=1) > SAME) & (moments < steps[-1]))
    known = away.min(axis=0) <= SAME
    if not new.size:
        return point
    rest = between(steps[known], (point.stress[:-1] - history[same])[known], moments[new])
    positions = np.concatenate([steps, moments[new]])
    order = np.argsort(positions)
    stress = np.concatenate([np.concatenate([point.stress[:-1], history[new] + rest])[order], point.stress[-1:]])
    return replace(point, stress=stress, positions=positions[order])


def _searched(points):
    """The WorstPoints with the values and planes of their histories; those with equal moments at once."""
    out = list(points)
    for group in {(point.depth, len(point.stress)) for point in points if point.positions is not None}:
        some = [n for n, point in enumerate(points) if (point.depth, len(point.stress)) == group]
        local = points[some[0]].local
        f, normals = findley.search(np.stack([points[n].stress for n in some]), local.kappa, criterion=local.criterion)
        for n, value, normal in zip(some, f, normals):
            out[n] = replace(points[n], f=max(float(value), points[n].f), normal=normal)
    return out


def between(known, values, at):
    """Values (m, ...) at positions `at` (m,) from `values` (n, ...) at the rising positions `known` (n,): the polynomial
    through the POINTS nearest ones."""
    count = min(POINTS, known.size)
    first = np.clip(np.searchsorted(known, at, side="right") - count // 2, 0, known.size - count)
    near = first[:, None] + np.arange(count)
    weights = [np.broadcast_to(weight, at.shape) for weight in lagrange(known[near].T, at)]
    return np.einsum("nm,mn...->m...", weights, values[near])
