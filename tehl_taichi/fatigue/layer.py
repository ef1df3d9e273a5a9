"""All material points at one depth: their stresses, their critical planes, the worst of them."""

import functools
from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import findley, index_statistics, stress_cycles, von_mises
from tehl_taichi.fatigue.stress.row_histories import at_the_surface
from tehl_taichi.fatigue.worst_point import WorstPoint, over_some, worse


@dataclass(frozen=True)
class EarlyLayer:
    """Results of the early moments at one depth: Findley stress f (nx, rows) Pa, and the worst point."""

    depth: float
    f: np.ndarray
    worst: WorstPoint


@dataclass(frozen=True)
class Layer:
    """Results at one depth: maps (nx, rows), the worst point, the largest von Mises stress (if wanted), and the EarlyLayer of
    the early moments where it is wanted. cycles: above the limit per passage, nan at points that are not in the sample. Of a
    passage whose worst point alone is wanted f is as :func:`tehl_taichi.fatigue.findley.search` gives it, sigma1 is nan.
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


def layer(scene, passage, depth, progress, early):
    """Find a Layer: stresses and search of all points at a depth (m). early: moments that are searched apart, or None."""
    parts, worst, peaks, sooner = [], None, [], _Early(scene, passage, depth, early)
    counted = index_statistics.sample(index_statistics.weights(passage)) & (not passage.worst)
    local = passage.strength.at(depth)
    for rows, history in _blocks(scene, passage, depth, progress):
        f, normals = findley.search(history, local.kappa, criterion=local.criterion, notify=progress, worst=passage.worst)
        shape = passage.x.size, rows.stop - rows.start
        cycles = _cycles(history, normals, counted[:, rows].ravel(), local)
        tension = np.full(len(f), np.nan) if passage.worst else von_mises.largest(history, findley.largest_principal)
        parts.append([v.reshape(shape) for v in (f, *findley.angles(normals), tension, cycles)])
        worst = worse(worst, passage.places(depth, rows), history, f, normals, local)
        peaks += [von_mises.peak(history, passage.places(depth, rows))] if passage.steel else []
        sooner.add(rows, history, (f, normals))
    return Layer(depth, *(np.concatenate(part, axis=1) for part in zip(*parts)), worst, max(peaks, default=None), sooner.found)


def early_layer(scene, passage, depth, progress, early):
    """The EarlyLayer of these moments alone at a depth (m)."""
    sooner = _Early(scene, passage, depth, early)
    for rows, history in _blocks(scene, passage, depth, progress):
        sooner.add(rows, history)
    return sooner.found


def _blocks(scene, passage, depth, progress):
    """(rows, stress histories of their points at that depth), block by block."""
    histories = (functools.partial(passage.history, operators=passage.stresses(depth), depth=depth) if depth
                 else at_the_surface(passage))
    for rows in passage.row_blocks():
        yield rows, histories(rows, notify=progress, meanwhile=lambda: findley.prepare(scene.fatigue.criterion))


class _Early:
    """Gathers the EarlyLayer of the early moments, block by block; early None: there is none."""

    def __init__(self, scene, passage, depth, early):
        self.scene, self.passage, self.depth, self.early = scene, passage, depth, early
        self.parts, self.worst = [], None

    def add(self, rows, history, known=None):
        """Search those moments of a block; known: (f, normals) of all of its moments."""
        if self.early is None:
            return
        places = self.passage.places(self.depth, rows)
        f, self.worst = over_some(history, self.early, self.passage, self.depth, places, known, self.worst)
        self.parts.append(f.reshape(self.passage.x.size, -1))

    @property
    def found(self):
        return EarlyLayer(self.depth, np.concatenate(self.parts, axis=1), self.worst) if self.parts else None


def _cycles(history, normals, counted, local):
    """Cycles above the limit at the points that are counted, else nan; (points,). local: LocalStrength there."""
    out = np.full(len(history), np.nan)
    for n in np.flatnonzero(counted):
        out[n] = stress_cycles.above(history[n], normals[n], local)
    return out
