"""The march in time of a window that rides with a feature: each of its steps as in a passage, driven by the states of the run.

Pressure along its border, rigid approach, the film that is bent from outside and the history of rho H along the border are
those of the run, between whose steps it takes `factor` of its own.
"""

import numpy as np

from tehl_taichi.march.coupling import carefully
from tehl_taichi.march.substeps import Substeps
from tehl_taichi.march.zoom.base_states import BaseStates
from tehl_taichi.march.zoom.outside_gap import OutsideGap
from tehl_taichi.march.zoom.refining import Refining
from tehl_taichi.march.zoom.window_levels import WindowLevels
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.isothermal import OneTemperature
from tehl_taichi.pressure.newton import RISES, PressureSolver
from tehl_taichi.pressure.storage_term import ORDER, Storage

SHEAR = "traction_x_a", "traction_y_a", "traction_x_b", "traction_y_b"
PAD = 4  # cells of the run beside the window whose history is kept: more than it moves and paths reach in ORDER steps


class WindowPassage:
    """The passage of `window` (:class:`tehl_taichi.march.zoom.window.Window`) through the run of `scene` in `reader`."""

    def __init__(self, scene, reader, window):
        self.scene, self.window, self.base = scene, window, BaseStates(scene, reader)
        self.levels = WindowLevels(scene, window)
        self.outside = OutsideGap(self.base, self.levels)
        self.film = OneTemperature(self.levels)
        self.solver = PressureSolver(self.levels, self.film, RISES, carries_load=False)
        self.given = self.levels.get(fields.MASK) == 0
        self.parts, self.defects, self.old = Substeps(), [], []
        self.dT = self.base.way * scene.operation.u_m / scene.reference.speed / window.factor
        self.resting = 0, self._refining(0, window.all_nx + 1).smooth(self.base.at(0).mass)
        self.storage = None

    def begin(self, step):
        """Take over the run at this step, with its history."""
        moments = [at for at in (step - n / self.window.factor for n in range(ORDER)) if at >= 0]
        self.old = [self._kept(state, self.window.origin(state.X)) for state in map(self.base.at, moments)]
        self._put(self.base.at(step))
        self.storage = Storage(self.levels)
        self.storage.lengths = [self.dT] * (len(self.old) - 1)

    def advance(self, step):
        """From `step` to the next of the run. Returns the reports of its steps; the last one has not converged where it failed
        for good."""
        done, whole, reports = 0.0, self.window.factor, []
        while done < whole - 1e-9:
            part = min(self.parts.next(done % 1.0), whole - done)
            report = self._try(step + (done + part) / whole, part)
            reports.append(report)
            if report.converged:
                done += part
                self.parts.accept(part)
            elif not self.parts.reject(part):
                break
        return reports

    def _try(self, at, part):
        """The state at a moment of the run, `part` of a step after the last accepted one; accepted if it converged."""
        state = self.base.at(at)
        origin, ring = self._put(state)
        self._follow(origin, part * self.dT)
        guess = np.where(self.given, ring, np.maximum(ring + self._defect(), 0.0))
        self.levels.put(fields.P, guess)
        self.solver.H0 = state.H0
        report = carefully(self.solver, guess)
        if report.converged:
            self._accept(state, origin, ring, part * self.dT)
        return report

    def fields(self):
        """{name: (ny+1, nx+1)} of the newest state, SI."""
        v, s = self.levels, self.levels.scales
        shear = dict(zip(SHEAR, self.film.tractions()))
        return {"pressure": v.get(fields.P) * s.p_H, "film": v.get(fields.H) * s.h, **shear}

    def _put(self, state):
        """Gap and pressure of the run at a state into the tables. Returns the window's first column, and that pressure."""
        origin = self.window.origin(state.X)
        ring = self._refining(origin, self.window.nx + 1).pressure(state.P)
        self.outside.put(state, origin, ring)
        self.levels.put(fields.P, ring)
        self.levels.set_film(state.H0)
        self.film.values()
        return origin, ring

    def _refining(self, first, columns):
        """From the nodes of the run to `columns` of the fine grid and the rows of the window."""
        w, grid = self.window, self.base.grid
        return Refining((w.row, first), (w.ny + 1, columns), w.factor, (grid.ny + 1, grid.nx + 1), self.base.mirrored)

    def _follow(self, origin, dT):
        """History of rho H under the window as it lies now, and the storage term of a step of dT."""
        self.storage.replace(self._under(origin, *self.resting), [self._under(origin, *kept) for kept in self.old])
        self.storage.begin(dT)

    def _defect(self):
        """What the window's pressure will differ from the run's by, in the frame of the window."""
        if len(self.defects) < 2:
            return self.defects[0] if self.defects else 0.0
        return 2 * self.defects[0] - self.defects[1]

    def _accept(self, state, origin, ring, dT):
        v = self.levels
        self.origin = origin
        self.old = [self._kept(state, origin, v.get(fields.RHO) * v.get(fields.H)), *self.old[: ORDER - 1]]
        self.defects = [v.get(fields.P) - ring, *self.defects[:1]]
        self.storage.accept(dT)

    def _kept(self, state, origin, mass=None):
        """(first column, rho H) of a state under the window and beside it: that of the run but where the window's is `mass`."""
        beside, w = PAD * self.window.factor, self.window
        first = max(origin - beside, 0)
        last = min(origin + w.nx + beside, w.all_nx)
        out = self._refining(first, last - first + 1).smooth(state.mass, 4)
        if mass is not None:
            own = out[:, origin - first : origin - first + w.nx + 1]
            own[~self.given] = mass[~self.given]
        return first, out

    def _under(self, origin, first, field):
        """A field of the fine grid from column `first` on, at the nodes of the window; beyond its ends as there."""
        columns = np.arange(origin, origin + self.window.nx + 1) - first
        return field[:, np.clip(columns, 0, field.shape[1] - 1)]
