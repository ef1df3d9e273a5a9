"""Stress histories of points of a smooth body that pass through the steady contact."""

import numpy as np

from tehl_taichi.fatigue.stress.histories import LOADED, StressHistories
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.strength.strength import Strength
from tehl_taichi.values.arrays import nearest_index


class Steady:
    """Steady start of a run, twice, as the reader of a passage without changes.

    reader: as for :class:`tehl_taichi.fatigue.stress.histories.StressHistories`; apart: s.
    """

    def __init__(self, reader, apart):
        self.reader, self.x, self.y, self.time = reader, reader.x, reader.y, np.array([0.0, apart])

    def __len__(self):
        return 2

    def fields(self, n, names):
        """{name: (nx+1, ny+1) array} of the steady start."""
        return self.reader.fields(0, names)


class SteadySweep(StressHistories):
    """Histories of one material point on a row (`middle`: that through the centre) that moves through the steady fields, one
    cell per moment; `positions`: its coordinates (m). scene, reader, surface: as for the base class.
    """

    block = 1  # one entry, which every moment reads

    def __init__(self, scene, reader, surface):
        self.scene, self.surface, self.last_below, self.a = scene, surface, {}, Scales.of(scene).a
        self.loads_of, self.strength = self._names(), Strength(scene.fatigue, surface)
        self.dx = float(reader.x[-1] - reader.x[0]) / (reader.x.size - 1)
        self.reader = Steady(reader, self.dx / surface.speed)
        self.middle = nearest_index(reader.y, 0.0)
        self.rows, self.x = slice(self.middle, self.middle + 1), np.zeros(1)
        self.y = reader.y[self.rows]
        first = int(np.ceil((-LOADED * self.a - reader.x[0]) / self.dx))  # on nodes: no interpolation
        count = int(2 * LOADED * self.a / self.dx) + 1
        self.centres = self.positions = reader.x[0] + (first + np.arange(count)) * self.dx
        self.entries = np.zeros(count, int)
        self._widen(self.x[0], self.x[-1])
