"""Deflection in a window by the pressure outside of it. It is smooth, so it is interpolated from the run.

It is the deflection of the run, less the deflection by the run's pressure inside the window (a small convolution on the nodes
of the run). The window itself computes the deflection by the pressure along its border, so that part is subtracted, too.
"""

import numpy as np

from tehl_taichi.pressure import fields, influence
from tehl_taichi.values.refining import Refining

BESIDE = 4  # nodes of the run around the window


class OutsideGap:
    """Gap of a window; base: the BaseStates of the run; levels: the WindowLevels."""

    def __init__(self, base, levels):
        self.base, self.levels, w = base, levels, levels.window
        grid, r = base.grid, w.factor
        self.columns = min(w.nx // r + 2 * BESIDE + 1, grid.nx + 1)
        self.rows = min(w.ny // r + 2 * BESIDE + 1, grid.ny + 1) if grid.ny else 1
        self.row = min(max(w.row // r - BESIDE, 0), grid.ny + 1 - self.rows) if grid.ny else 0
        self.mirrored = base.mirrored
        self.kernel = self._spectrum(grid, levels.scales)

    def _spectrum(self, grid, scales):
        """Transform of the deflection by a unit pressure at one node, on a padded grid of the run's nodes around the window."""
        rows = 2 * self.rows if self.mirrored else self.rows
        if grid.ny:
            one = influence.rectangle(self.columns, rows, grid.dx, grid.dy, scales.compliance)[:-1, :-1].T
        else:
            one = influence.strip(self.columns, grid.dx)[None, :-1]
        two = np.concatenate([one, 0 * one[:, :1], one[:, :0:-1]], axis=1)
        two = np.concatenate([two, 0 * two[:1], two[:0:-1]]) if grid.ny else two
        return np.fft.rfft2(two)

    def bent(self, P):
        """Deflection (rows, columns) by the pressure P (rows, columns) on the run's nodes around the window."""
        whole = np.concatenate([P[:0:-1], P]) if self.mirrored else P
        shape = self.kernel.shape[0], 2 * self.columns
        out = np.fft.irfft2(np.fft.rfft2(whole, shape) * self.kernel, shape)[: whole.shape[0], : self.columns]
        return out[P.shape[0] - 1 :] if self.mirrored else out

    def put(self, state, origin, ring):
        """Write GAP0 of the window: undeformed gap, features after run-in, deflection by the pressure outside.

        state: BaseState; origin: first fine column of the window; ring: pressure of the run (ny+1, nx+1) at the window's nodes.
        """
        v = self.levels
        v.place(origin)
        gap = self.base.gap(v.smooth_gap(), v, state.X)
        v.put(fields.GAP0, gap + self._far(state, origin) - self._own(ring, origin))

    def _far(self, state, origin):
        """Deflection of the run less that by its pressure in the core of the window, at the nodes of the window."""
        w, grid, r = self.levels.window, self.base.grid, self.levels.window.factor
        first = min(max(origin // r - BESIDE, 0), grid.nx + 1 - self.columns)
        columns, rows = slice(first, first + self.columns), slice(self.row, self.row + self.rows)
        nodes = r * np.arange(first, first + self.columns), r * np.arange(self.row, self.row + self.rows)
        left = state.bent[rows, columns] - self.bent(w.core(*nodes, origin) * state.P[rows, columns])
        own = Refining((w.row - r * self.row, origin - r * first), (w.ny + 1, w.nx + 1), r, left.shape, self.mirrored)
        return own.smooth(left)

    def _own(self, ring, origin):
        """Deflection by the run's pressure along the border, as the window computes it."""
        v, w = self.levels, self.levels.window
        core = w.core(np.arange(origin, origin + w.nx + 1), np.arange(w.row, w.row + w.ny + 1), origin)
        v.put(fields.P, (1.0 - core) * ring)
        v.put(fields.GAP0, np.zeros(1))
        v.set_film(0.0)
        return v.get(fields.H)
