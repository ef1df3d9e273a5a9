"""The march in time of a window that rides with a feature: each of its steps as in a passage, driven by the states of the run.

Pressure and temperatures along its border, rigid approach, the film that is bent from outside and the history of rho H along
the border are those of the run, between whose steps it takes `factor` of its own.
"""

import numpy as np

from tehl_taichi.march.coupling import carefully, exchange, rounds
from tehl_taichi.march.substeps import Substeps
from tehl_taichi.march.zoom.outside_gap import OutsideGap
from tehl_taichi.march.zoom.two_frames import TwoFrames
from tehl_taichi.march.zoom.window_heat import WindowHeat
from tehl_taichi.march.zoom.window_levels import WindowLevels
from tehl_taichi.march.zoom.zoomed_reader import EXTREMES
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.isothermal import OneTemperature
from tehl_taichi.pressure.newton import RISES, pressure_solver
from tehl_taichi.pressure.storage_term import ORDER, Storage
from tehl_taichi.values.refining import Refining

SHEAR = "traction_x_a", "traction_y_a", "traction_x_b", "traction_y_b"
GUESSED = 2  # order of the guess of the pressure
PAD = 4  # cells of the run beside the window whose history is kept: more than it moves and paths reach in ORDER steps


class WindowPassage:
    """The passage of `window` (:class:`tehl_taichi.march.zoom.window.Window`) through the run whose states are `base`
    (:class:`tehl_taichi.march.zoom.base_states.BaseStates`)."""

    def __init__(self, base, window):
        self.scene, self.window, self.base = base.scene, window, base
        self.levels = WindowLevels(self.scene, window)
        self.outside = OutsideGap(self.base, self.levels)
        self.given = self.levels.get(fields.MASK) == 0
        whole = self.base.way * self.scene.operation.u_m / self.scene.reference.speed
        self.dT = whole / window.factor
        self.heat = WindowHeat(base, self.levels, self._refining, self.given, whole * base.scales.t) if base.heat else None
        self.film = self.heat.film if self.heat else OneTemperature(self.levels)
        self.solver = pressure_solver(self.levels, self.film, RISES, carries_load=False)
        self.guess = TwoFrames(GUESSED, self._refining(0, window.all_nx + 1).pressure(base.at(0).P))
        self.parts, self.old = Substeps(), []
        self.resting = 0, self._refining(0, window.all_nx + 1).smooth(self.base.at(0).mass)
        self.storage = None

    def begin(self, step):
        """Take over the run at this step, with its history."""
        moments = [at for at in (step - n / self.window.factor for n in range(ORDER)) if at >= 0]
        self.old = [self._kept(state, self.window.origin(state.X)) for state in map(self.base.at, moments)]
        state = self.base.at(step)
        origin, ring = self._put(state)
        self.guess.accept(ring, ring, origin, self._at(state))
        if self.heat:
            self.heat.take_over(step, origin, self._at(state))
        self.storage = Storage(self.levels)
        self.storage.lengths = [self.dT] * (len(self.old) - 1)

    def advance(self, step):
        """From `step` to the next of the run. Returns the reports of its steps; the last one has not converged where it failed
        for good."""
        done, whole, reports, self.extremes = 0.0, self.window.factor, [], []
        while done < whole - 1e-9:
            part = min(self.parts.next(done % 1.0), whole - done)
            report = self._try(step + (done + part) / whole, part)
            reports.append(report)
            if report.converged:
                done += part
                self.parts.accept(part)
            elif not self.parts.reject(part) and not self.parts.hold(self.heat and self.film):
                return reports
        if self.heat:
            self.heat.refresh(step + 1)
        return reports

    def _try(self, at, part):
        """The state at a moment of the run, `part` of a step after the last accepted one; accepted if it converged."""
        state = self.base.at(at)
        origin, ring = self._put(state)
        self._follow(origin, part * self.dT)
        guess = np.where(self.given, ring, np.maximum(self.guess.next(ring, origin, self._at(state)), 0.0))
        self.levels.put(fields.P, guess)
        self.solver.H0 = state.H0
        report = self._solve(guess, state, origin, part)
        if report.converged:
            self._accept(state, origin, ring, part * self.dT)
        return report

    def _solve(self, guess, state, origin, part):
        """Pressure, and temperatures where there are any, of a step from this pressure on. Returns a SolveReport."""
        def pressure():
            return carefully(self.solver, guess)

        if not self.heat:
            return pressure()
        self.heat.begin(state.T, origin, self._at(state), part * self.dT * self.base.scales.t)
        return exchange(self.solver, self.film, pressure, rounds(self.scene, part), sparing=True)

    def fields(self):
        """{name: (ny+1, nx+1)} of the newest state, SI."""
        v, s = self.levels, self.levels.scales
        shear = dict(zip(SHEAR, self.film.tractions()))
        warm = self.heat.fields() if self.heat else {}
        return {"pressure": v.get(fields.P) * s.p_H, "film": v.get(fields.H) * s.h, **shear, **warm}

    def numbers(self, step):
        """{name: number} of all its moments since the step before: largest pressure and smallest film of the window alone,
        highest temperatures of the run with it."""
        found = {name: extreme([one[name] for one in self.extremes]) for name, (_, extreme) in EXTREMES.items()}
        outside = self.heat.outside(self.base.at(step).T) if self.heat else {}
        return {**found, **{name: max(there, *(one[name] for one in self.extremes)) for name, there in outside.items()}}

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

    def _at(self, state):
        """Place of the first feature, columns of the fine grid."""
        return state.X / self.window.dx

    def _extremes(self, origin):
        """{name: number} of the newest state, of nodes that are the window's own."""
        v, s, inside = self.levels, self.levels.scales, self.window.inside(origin)
        found = {"p_max_Pa": v.get(fields.P)[inside].max() * s.p_H, "h_min_m": v.get(fields.H)[inside].min() * s.h}
        return found | (self.heat.inside() if self.heat else {})

    def _accept(self, state, origin, ring, dT):
        v = self.levels
        self.origin = origin
        self.old = [self._kept(state, origin, v.get(fields.RHO) * v.get(fields.H)), *self.old[: ORDER - 1]]
        self.guess.accept(v.get(fields.P), ring, origin, self._at(state))
        self.storage.accept(dT)
        if self.heat:
            self.heat.accept(origin, self._at(state))
        self.extremes.append(self._extremes(origin))

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
