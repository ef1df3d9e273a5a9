"""Elastic stresses of a passage in the cells that may yield, moment by moment.

First a look at every third layer at the moments whose pressure may yield anything: where nothing comes near, that is all.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.stress.thermal_stress import WORKERS
from tehl_taichi.fatigue.von_mises import von_mises

APART = 0.05    # a: moments that are followed are no closer
NEAR = 0.8      # of the flow stress: cells with less do not yield by what flow around them adds
PRESSED = 1.2   # of the flow stress: pressures below it flow nowhere (von Mises stresses are 0.65 of a pressure at most)
EVERY = 3       # layers of the first look


@dataclass(frozen=True)
class ElasticLoads:
    """moments: [(cells (layers, x, y) numbers, stress (n, 6) Pa)] of the cells that may yield; largest: von Mises stress, with
    the residual one, over the flow stress, of all cells and moments that were looked at."""

    moments: list
    largest: float


def histories(scene, reader, surface):
    """The :class:`StressHistories` of a passage, with all of its moments and shear."""
    whole = replace(scene.fatigue, from_x=-np.inf, to_x=np.inf, shear=True)
    positions = np.array([reader.feature_x(n) for n in range(len(reader))])
    return StressHistories(replace(scene, fatigue=whole), reader, positions, surface=surface)


def find(passage, cells, state):
    """The :class:`ElasticLoads` of a passage over :class:`tehl_taichi.plastic.steel_body.Cells` in a SteelState."""
    look = _Look(passage, cells, state)
    count = cells.layers.count
    first = {layer: look.at(layer, look.times) for layer in range(0, count, EVERY)}
    near = [t for t in look.times if max(found[t].largest for found in first.values()) > NEAR]
    for layer in range(count):
        if layer not in first and near and max(_beside(first, layer)) > NEAR:
            first[layer] = look.at(layer, near)
    moments = [_joined([found[t] for found in first.values()]) for t in near]
    return ElasticLoads(moments, max((one.largest for found in first.values() for one in found.values()), default=0.0))


def _beside(found, layer):
    """Largest von Mises stresses of the layers of the first look on both sides."""
    sides = [n for n in (layer - layer % EVERY, layer - layer % EVERY + EVERY) if n in found]
    return [max((one.largest for one in found[n].values()), default=0.0) for n in sides]


@dataclass(frozen=True)
class _Seen:
    """A layer at a moment: the largest von Mises stress over the flow stress, the cells close to it, their stress."""

    largest: float
    places: np.ndarray
    stress: np.ndarray


class _Look:
    """Stresses of a passage in layers, beside what steel flows at there."""

    def __init__(self, passage, cells, state):
        self.passage, self.state, self.depths = passage, state, cells.layers.depths
        self.limits = [cells.flow_stress(np.array(n), hard) for n, hard in enumerate(state.hardened)]
        self.rows = slice(0, passage.rows.stop - passage.rows.start)
        self.times = self._moments(min(float(limit.min()) for limit in self.limits))

    def _moments(self, limit):
        """Numbers of the moments that are pressed enough, and apart enough; none of the steady start, where nothing flows."""
        passage = self.passage
        stride = max(1, int(APART * passage.a / passage.dx + 1e-9))
        way = np.abs(passage.centres - passage.centres[0]) / passage.dx
        first = np.unique(np.floor(way / stride + 1e-6), return_index=True)[1]
        return [int(t) for t in first if passage.entries[t] and self._pressure(passage.entries[t]) > PRESSED * limit]

    def _pressure(self, entry):
        return self.passage.reader.fields(int(entry), ("pressure",))["pressure"].max()

    def at(self, layer, times):
        """{moment: _Seen} of a layer."""
        operators = self.passage.stresses(self.depths[layer])
        with ThreadPoolExecutor(WORKERS) as pool:
            return dict(zip(times, pool.map(lambda t: self._seen(layer, t, operators), times)))

    def _seen(self, layer, t, operators):
        passage, depth = self.passage, self.depths[layer]
        stress = passage.under(passage._stress_field(int(passage.entries[t]), self.rows, *operators), t)
        for component, value in zip(stress, passage.strength.residual(depth)):
            component += value
        stress = np.moveaxis(stress, 0, -1)
        left = np.moveaxis(self.state.residual[layer], 0, -1)
        share = np.maximum(von_mises(stress + left), von_mises(stress)) / self.limits[layer]
        x, y = np.nonzero(share > NEAR)
        places = np.stack([np.full_like(x, layer), x, y])
        largest = von_mises(stress + left) / self.limits[layer]
        return _Seen(float(largest.max()), places, stress[x, y].astype(np.float32))


def _joined(seen):
    """(places, stress) of all layers of a moment."""
    places, stress = [one.places for one in seen], [one.stress for one in seen]
    return tuple(np.concatenate(places, axis=1)), np.concatenate(stress).astype(float)
