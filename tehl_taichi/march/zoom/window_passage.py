"""Time steps of a window that moves with a feature, driven by the states of the run.

These values are those of the run: pressure and temperatures along the border, the rigid approach, the deflection by the
pressure outside, and the history of rho H along the border. The window takes `factor` steps per step of the run.
"""

import numpy as np

from tehl_taichi.march.coupling import carefully, exchange
from tehl_taichi.march.substeps import Substeps
from tehl_taichi.march.zoom import overlap
from tehl_taichi.march.zoom.outside_gap import OutsideGap
from tehl_taichi.march.zoom.overlap import PlacedWindow
from tehl_taichi.march.zoom.two_frames import TwoFrames
from tehl_taichi.march.zoom.window_heat import WindowHeat, highest
from tehl_taichi.march.zoom.window_levels import WindowLevels
from tehl_taichi.march.zoom.zoomed_reader import EXTREMES
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.isothermal import OneTemperature
from tehl_taichi.pressure.newton import RISES, pressure_solver
from tehl_taichi.pressure.storage_term import ORDER, Storage
from tehl_taichi.values.refining import Refining

SHEAR = "traction_x_a", "traction_y_a", "traction_x_b", "traction_y_b"
SHOWN = "film", "temperature_mid"  # fields that no stress depends on
GUESSED = 2  # order of the guess of the pressure
PAD = 4  # cells of the run around the window whose history is kept: more than the window and the oil move in ORDER steps


class WindowPassage:
    """The passage of a window through a run.

    base: :class:`tehl_taichi.march.zoom.base_states.BaseStates` of the run; window: its Window; others: the other Windows of
    the run, where they overlap it.
    """

    def __init__(self, base, window, others=()):
        self.scene, self.window, self.base, self.others = base.scene, window, base, others
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
        """Start from the state of the run at this step, with its history."""
        moments = [at for at in (step - n / self.window.factor for n in range(ORDER)) if at >= 0]
        self.old = [self._kept(state, self.window.origin(state.X)) for state in map(self.base.at, moments)]
        state = self.base.at(step)
        origin, ring = self._put(state)
        self.levels.put(fields.P, ring)
        self.levels.set_film(state.H0)
        self.film.values()
        self.guess.accept(ring, ring, origin, self._at(state))
        if self.heat:
            self.heat.take_over(step, origin, self._at(state))
        self.storage = Storage(self.levels)
        self.storage.lengths = [self.dT] * (len(self.old) - 1)

    def advance(self, step):
        """Advance from `step` of the run to the next one, in shorter steps where one fails.

        Returns the SolveReports of the steps. If the last one has not converged, the window cannot continue. `between`:
        [(moment in steps of the run, first fine column, {name: field})] of its own steps between the two, by :meth:`fields`.
        """
        done, whole, reports, self.extremes, self.between = 0.0, self.window.factor, [], [], []
        while done < whole - 1e-9:
            part = min(self.parts.next(done % 1.0), whole - done)
            report = self._try(step + (done + part) / whole, part)
            reports.append(report)
            if report.converged:
                done += part
                self.parts.accept(part)
                self._keep(step, done)
            elif not self.parts.reject(part) and not self.parts.hold(self.heat and self.film):
                return reports
        if self.heat:
            self.heat.refresh(step + 1)
        return reports

    def _keep(self, step, done):
        """Keep the loads and temperatures of the newest state, `done` steps of the window after `step` of the run, if it lies
        between two of the run's steps and whole steps of the window led there."""
        if done < self.window.factor - 1e-9 and abs(done - round(done)) < 1e-9:
            loads = {name: field for name, field in self.fields().items() if name not in SHOWN}
            self.between.append((step + round(done) / self.window.factor, self.origin, loads))

    def _try(self, at, part):
        """Solve the state at a moment `at` of the run (in its steps), `part` of a window's step after the last accepted one.

        Accepts it if it converges. Returns the SolveReport.
        """
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
        """Solve pressure and temperatures of a step from the pressure `guess`; return the SolveReport."""
        def pressure():
            return carefully(self.solver, guess)

        if not self.heat:
            return pressure()
        self.heat.begin(state.T, origin, self._at(state), part * self.dT * self.base.scales.t)
        return exchange(self.solver, self.film, pressure, sparing=True)

    def fields(self):
        """{name: (nx+1, ny+1) f4} of the newest state, SI units."""
        v, s = self.levels, self.levels.scales
        shear = dict(zip(SHEAR, self.film.tractions()))
        warm = self.heat.fields() if self.heat else {}
        found = {"pressure": v.get(fields.P) * s.p_H, "film": v.get(fields.H) * s.h, **shear, **warm}
        return {name: np.ascontiguousarray(field.T, np.float32) for name, field in found.items()}

    def numbers(self, step):
        """{name: number} over all moments since the last step of the run.

        Largest pressure and smallest film of the window alone; highest temperatures of the window and of the run outside of all
        windows.
        """
        found = {name: extreme([one[name] for one in self.extremes]) for name, (_, extreme) in EXTREMES.items()}
        outside = self._outside(self.base.at(step)) if self.heat else {}
        return {**found, **{name: max(there, *(one[name] for one in self.extremes)) for name, there in outside.items()}}

    def _outside(self, state):
        """{name: highest temperature, deg C} of the run's `state` outside of all windows."""
        return highest(state.T[:, overlap.outside(self._placed(state))])

    def _put(self, state):
        """Write the gap of the run's `state` into the tables; return the window's first fine column and the run's pressure
        (ny+1, nx+1) in it."""
        origin = self.window.origin(state.X)
        ring = self._refining(origin, self.window.nx + 1).pressure(state.P)
        self.outside.put(state, origin, ring)
        return origin, ring

    def _refining(self, first, columns):
        """Interpolation from the run's nodes to `columns` fine columns from `first` on and the rows of the window."""
        w, grid = self.window, self.base.grid
        return Refining((w.row, first), (w.ny + 1, columns), w.factor, (grid.ny + 1, grid.nx + 1), self.base.mirrored)

    def _follow(self, origin, dT):
        """Prepare the storage term of a step dT, with the history of rho H at the present position of the window."""
        self.storage.replace(self._under(origin, *self.resting), [self._under(origin, *kept) for kept in self.old])
        self.storage.begin(dT)

    def _at(self, state):
        """Place of the origin of the surface in fine columns from X = 0."""
        return self.window.pace * state.X / self.window.dx

    def _placed(self, state):
        """PlacedWindows of this window and of the others at a state of the run."""
        return [PlacedWindow.of(window, state.X) for window in (self.window, *self.others)]

    def _extremes(self, state):
        """{name: number} of the newest state, at the nodes that belong to the window."""
        own, *others = self._placed(state)
        v, s, inside = self.levels, self.levels.scales, overlap.inside(own, others)
        found = {"p_max_Pa": v.get(fields.P)[inside].max() * s.p_H, "h_min_m": v.get(fields.H)[inside].min() * s.h}
        return found | (highest(self.film.T[:, inside]) if self.heat else {})

    def _accept(self, state, origin, ring, dT):
        """Accept the solved state as the newest one."""
        v = self.levels
        self.origin = origin
        self.old = [self._kept(state, origin, v.get(fields.RHO) * v.get(fields.H)), *self.old[: ORDER - 1]]
        self.guess.accept(v.get(fields.P), ring, origin, self._at(state))
        self.storage.accept(dT)
        if self.heat:
            self.heat.accept(origin, self._at(state))
        self.extremes.append(self._extremes(state))

    def _kept(self, state, origin, mass=None):
        """(first fine column, rho H) of a state in and around the window.

        It is the run's rho H, replaced inside the window's border by `mass` (None: not replaced).
        """
        beside, w = PAD * self.window.factor, self.window
        first = max(origin - beside, 0)
        last = min(origin + w.nx + beside, w.all_nx)
        out = self._refining(first, last - first + 1).smooth(state.mass, 4)
        if mass is not None:
            own = out[:, origin - first : origin - first + w.nx + 1]
            own[~self.given] = mass[~self.given]
        return first, out

    def _under(self, origin, first, field):
        """Field (ny+1, nx+1) at the window's nodes, from a `field` that begins at fine column `first`; constant beyond its
        ends."""
        columns = np.arange(origin, origin + self.window.nx + 1) - first
        return field[:, np.clip(columns, 0, field.shape[1] - 1)]
