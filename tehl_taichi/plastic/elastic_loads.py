"""Elastic stresses of a passage in the cells that may yield, moment by moment.

First some layers are computed at those moments whose pressure may cause yielding. If none of them comes near yielding, nothing
more is computed.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.stress.workers import WORKERS
from tehl_taichi.fatigue.von_mises import von_mises

APART = 0.05    # a: moments that are followed are no closer
NEAR = 0.8      # of the flow stress: cells with less do not yield by what flow around them adds
PRESSED = 1.2   # of the flow stress: pressures below it flow nowhere (von Mises stresses are 0.65 of a pressure at most)
EVERY = 4       # layers of the first look
SOME = 3        # moments of the first look, besides those of the highest pressures around


@dataclass(frozen=True)
class ElasticLoads:
    """Elastic loads of a passage.

    moments: [(cell numbers (layers, x, y), stress (n, 6) Pa)] of the cells that may yield; largest: largest ratio of von Mises
    stress (with residual stress) to flow stress over all computed cells and moments.
    """

    moments: list
    largest: float


def histories(scene, reader, surface):
    """The :class:`StressHistories` of a passage with all of its moments and shear."""
    whole = replace(scene.fatigue, from_x=-np.inf, to_x=np.inf, shear=True)
    positions = np.array([reader.feature_x(n) for n in range(len(reader))])
    return StressHistories(replace(scene, fatigue=whole), reader, positions, surface=surface)


def find(passage, cells, state):
    """Find the :class:`ElasticLoads` of a passage. cells: :class:`tehl_taichi.plastic.steel_body.Cells`; state: SteelState."""
    look = _Look(passage, cells, state)
    count = cells.layers.count
    found = {layer: look.at(layer, look.first) for layer in range(0, count, EVERY)}
    near = look.around([t for t in look.first if max(seen[t].largest for seen in found.values()) > NEAR])
    deep = [layer for layer in range(count) if near and max(_neighbouring_ratios(found, layer)) > NEAR]
    for layer in deep:
        known = found.get(layer, {})
        found[layer] = known | look.at(layer, [t for t in near if t not in known])
    moments = [_joined_layers([found[layer][t] for layer in deep]) for t in near]
    return ElasticLoads(moments, max((seen.largest for each in found.values() for seen in each.values()), default=0.0))


def _neighbouring_ratios(found, layer):
    """Largest von Mises stress ratios of the first-computed layers at and beside a layer."""
    sides = {layer - layer % EVERY, layer - layer % EVERY + EVERY * (layer % EVERY > 0)} & found.keys()
    return [max((seen.largest for seen in found[n].values()), default=0.0) for n in sides]


@dataclass(frozen=True)
class _Seen:
    """Result of a layer at a moment: largest ratio of von Mises stress to flow stress, cells close to yielding, their
    stresses.
    """

    largest: float
    places: np.ndarray
    stress: np.ndarray


class _Look:
    """Elastic stresses of a passage in layers, compared with their flow stress."""

    def __init__(self, passage, cells, state):
        self.passage, self.state, self.depths = passage, state, cells.layers.depths
        self.limits = [cells.flow_stress(np.array(n), hard) for n, hard in enumerate(state.hardened)]
        self.rows = slice(0, passage.rows.stop - passage.rows.start)
        pressures = self._moments(min(float(limit.min()) for limit in self.limits))
        self.times, p = list(pressures), np.array(list(pressures.values()))
        top = [n for n in range(p.size) if p[n] == p[max(0, n - SOME) : n + SOME + 1].max()]
        self.first = [self.times[n] for n in sorted({*range(0, p.size, SOME), *top})]

    def _moments(self, limit):
        """{number: largest pressure} of the moments with enough pressure, thinned out; the steady start is left out (nothing
        flows in it).
        """
        passage = self.passage
        stride = max(1, int(APART * passage.a / passage.dx + 1e-9))
        way = np.abs(passage.centres - passage.centres[0]) / passage.dx
        first = np.unique(np.floor(way / stride + 1e-6), return_index=True)[1]
        pressures = {int(t): self._pressure(passage.entries[t]) for t in first if passage.entries[t]}
        return {t: p for t, p in pressures.items() if p > PRESSED * limit}

    def around(self, moments):
        """Numbers of all moments that are at most SOME away from the given first-computed ones."""
        places = {self.times.index(t) + n for t in moments for n in range(-SOME, SOME + 1)}
        return [t for n, t in enumerate(self.times) if n in places]

    def _pressure(self, entry):
        return self.passage.reader.fields(int(entry), ("pressure",))["pressure"].max()

    def at(self, layer, times):
        """{moment: _Seen} of a layer."""
        operators = self.passage.stresses(self.depths[layer])
        with ThreadPoolExecutor(WORKERS) as pool:
            return dict(zip(times, pool.map(lambda t: self._seen(layer, t, operators), times)))

    def _seen(self, layer, t, operators):
        passage, depth = self.passage, self.depths[layer]
        stress = passage.under(passage.stress_field(int(passage.entries[t]), self.rows, *operators), t)
        for component, value in zip(stress, passage.strength.residual(depth)):
            component += value
        stress = np.moveaxis(stress, 0, -1)
        left = np.moveaxis(self.state.residual[layer], 0, -1)
        share = np.maximum(von_mises(stress + left), von_mises(stress)) / self.limits[layer]
        x, y = np.nonzero(share > NEAR)
        places = np.stack([np.full_like(x, layer), x, y])
        largest = von_mises(stress + left) / self.limits[layer]
        return _Seen(float(largest.max()), places, stress[x, y].astype(np.float32))


def _joined_layers(seen):
    """(cell numbers, stresses) of all layers of a moment, joined."""
    places, stress = [one.places for one in seen], [one.stress for one in seen]
    return tuple(np.concatenate(places, axis=1)), np.concatenate(stress).astype(float)
