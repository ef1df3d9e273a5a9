"""Search of all material points at one depth: stresses, critical planes, worst point."""

import functools
from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.fatigue import findley, index_statistics, stress_cycles, von_mises
from tehl_taichi.fatigue.sought import Sought
from tehl_taichi.fatigue.stress.row_histories import at_the_surface
from tehl_taichi.fatigue.worst_point import WorstPoint, close_ones, over_some, worse


@dataclass(frozen=True)
class EarlyLayer:
    """Results of the early moments at one depth (m): value f (x', rows) Pa of the criterion, and the worst point."""

    depth: float
    f: np.ndarray
    worst: WorstPoint


@dataclass(frozen=True)
class Layer:
    """Results at one depth (m).

    Maps (x', rows): f, value of the criterion (Pa); theta, phi, angles of the critical plane (degrees); sigma1, largest
    principal stress (Pa); cycles above the limit per passage (nan at points outside the sample). worst: the worst point. mises:
    the largest von Mises stress, or None. early: results of the early moments, or None. If not all points are sought, f is that
    of `worst=True` of :func:`tehl_taichi.fatigue.findley.search`, and sigma1 and cycles are nan. close: the worst points at the
    surface, if the reader of the passage has moments between those of the run.
    """

    depth: float
    f: np.ndarray
    theta: np.ndarray
    phi: np.ndarray
    sigma1: np.ndarray
    cycles: np.ndarray
    worst: WorstPoint
    mises: von_mises.VonMisesPeak | None
    early: EarlyLayer | None
    close: list = field(default_factory=list)


def layer(scene, passage, depth, progress, early, averages=None):
    """Compute the stresses of all points at a depth (m) and search them; return the :class:`Layer`.

    progress: called with (done, total); early: numbers of the moments that are also searched alone, or None; averages: the
    :class:`tehl_taichi.fatigue.averaged_surface.AveragedSurface` that takes the histories, or None.
    """
    parts, worst, peaks, close, sooner = [], None, [], [], _Early(scene, passage, depth, early)
    follows = not depth and passage.follows
    counts, local = index_statistics.weights(passage), passage.strength.at(depth)
    brief = passage.sought.brief
    counted, needed = index_statistics.sample(counts) & (not brief), (counts > 0) & (passage.sought is Sought.COUNTED)
    for rows, history in _blocks(scene, passage, depth, progress):
        f, normals = findley.search(history, local.kappa, criterion=local.criterion, notify=progress, worst=brief,
                                    needed=needed[:, rows].ravel())
        shape = passage.x.size, rows.stop - rows.start
        cycles = _cycles(history, normals, counted[:, rows].ravel(), local)
        tension = np.full(len(f), np.nan) if brief else von_mises.largest(history, findley.largest_principal)
        parts.append([v.reshape(shape) for v in (f, *findley.angles(normals), tension, cycles)])
        worst = worse(worst, passage.places(depth, rows), history, f, normals, local)
        close = close_ones(close, passage.places(depth, rows), history, f, normals, local) if follows else []
        peaks += [von_mises.peak(history, passage.places(depth, rows))] if passage.steel else []
        sooner.add(rows, history, (f, normals))
        if averages:
            averages.add(rows, history, f)
    return Layer(depth, *(np.concatenate(part, axis=1) for part in zip(*parts)), worst, max(peaks, default=None), sooner.found,
                 close)


def early_layer(scene, passage, depth, progress, early):
    """Search only the moments `early` (their numbers) of all points at a depth (m); return the EarlyLayer."""
    sooner = _Early(scene, passage, depth, early)
    for rows, history in _blocks(scene, passage, depth, progress):
        sooner.add(rows, history)
    return sooner.found


def _blocks(scene, passage, depth, progress):
    """Generator of (slice of rows, stress histories (points, moments, 6) Pa at a depth), block by block."""
    histories = (functools.partial(passage.history, operators=passage.stresses(depth), depth=depth) if depth
                 else at_the_surface(passage))
    for rows in passage.row_blocks():
        yield rows, histories(rows, notify=progress, meanwhile=lambda: findley.prepare(scene.fatigue.criterion))


class _Early:
    """Collects the EarlyLayer block by block; does nothing if `early` is None."""

    def __init__(self, scene, passage, depth, early):
        self.scene, self.passage, self.depth, self.early = scene, passage, depth, early
        self.parts, self.worst = [], None

    def add(self, rows, history, known=None):
        """Search the early moments of a block; known: (f, normals) of all moments of the block."""
        if self.early is None:
            return
        places = self.passage.places(self.depth, rows)
        f, self.worst = over_some(history, self.early, self.passage, self.depth, places, known, self.worst)
        self.parts.append(f.reshape(self.passage.x.size, -1))

    @property
    def found(self):
        """The EarlyLayer, or None."""
        return EarlyLayer(self.depth, np.concatenate(self.parts, axis=1), self.worst) if self.parts else None


def _cycles(history, normals, counted, local):
    """Cycles above the limit (points,), nan at points that are not `counted` (bool); local: LocalStrength of the depth."""
    out = np.full(len(history), np.nan)
    for n in np.flatnonzero(counted):
        out[n] = stress_cycles.above(history[n], normals[n], local)
    return out
