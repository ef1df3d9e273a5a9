"""Passage of a feature through the contact: steady start, then a time march that yields snapshots.

A time step: move the feature, predict, solve pressure (film, cavitation, contact and load at once) and temperature alternately,
accept. All of it is in :class:`Passage`; a step that does not converge is divided into parts.
"""

import functools
import time

import numpy as np

from tehl_taichi.errors import NotConverged
from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march import snapshot
from tehl_taichi.march.coupling import carefully, exchange
from tehl_taichi.march.failure import crossed_surfaces, not_converged
from tehl_taichi.march.feature_gap import sink, with_features
from tehl_taichi.march.prediction import Prediction
from tehl_taichi.march.snapshot import Snapshot
from tehl_taichi.march.solved_state import SolvedState
from tehl_taichi.march.start import steady_snapshot
from tehl_taichi.march.substeps import Substeps
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.isothermal import OneTemperature
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.newton import RISES, pressure_solver
from tehl_taichi.pressure.storage_term import Storage
from tehl_taichi.scene import memory_demand
from tehl_taichi.scene.feature_wording import position_word
from tehl_taichi.scene.sections import AUTO
from tehl_taichi.scene.timeline import step_cells, total_steps

__all__ = ["NotConverged", "Passage", "Snapshot", "march", "total_steps"]


def march(scene, state=None, changes=()):
    """Yield a Snapshot per time step, from the steady start, or after the snapshot whose `state` is given.

    Read `state` from a snapshot before the next one is requested. changes: sinking of the surfaces by plastic flow
    (:class:`tehl_taichi.plastic.surface_change.SurfaceChange`). Equal states give equal steps, bit for bit. Raises SceneError
    without enough memory for the grid, NotConverged if a step fails finally.
    """
    memory_demand.check(scene)
    if state is None:
        first = steady_snapshot(scene)
        yield first
        state = first.state
    if total_steps(scene) > state["step"]:
        yield from Passage(scene, state, changes).steps()


class Passage:
    """Time march from a saved state."""

    def __init__(self, scene, state, changes=()):
        self.doubled, self.changes = bool(state.get("double", False)), changes
        self._set_up(scene, state)

    def _set_up(self, scene, state, done=0.0):
        """Create tables and solvers of a scene, at a state that has completed `done` of its next step."""
        scene = scene.replace(**{"numerics.precision": "f64"}) if self.doubled else scene
        self.scene, self.levels = scene, Levels(scene, scene.grid.nx, scene.rows, full=not scene.symmetric)
        self.scales = self.levels.scales
        self.smooth, self.border = self.levels.smooth_gap(), self.levels.get(fields.MASK).T == 0
        self.first, self.step_x = scene.path[0], step_cells(scene) * self.levels.dx
        self.dT = self.step_x * scene.operation.u_m / scene.reference.speed
        self.heat = None if scene.isothermal else FilmHeat(self.levels, self.dT * self.scales.t)
        # the film whose density and viscosity the pressure is solved for: they follow the temperatures, where there are any
        self.film = self.heat or OneTemperature(self.levels)
        self.solver = pressure_solver(self.levels, self.film, RISES)
        self._restore(state, done)

    def _restore(self, state, done):
        self.step, self.P, self.solver.H0 = int(state["step"]), np.array(state["P"]), float(state["H0"])
        self.solver.load = float(state.get("load", self.solver.load))  # as the border's pressure, that of the start
        self.parts = Substeps.of(state)
        self.levels.put(fields.P, self.P)
        if self.heat:
            self.heat.restore(state)
        self.prediction = Prediction(self.solver, self.heat, self._moved(self.step + done), state)
        self.storage = Storage(self.levels, state) if "mass" in state else self._new_storage()

    def _new_storage(self):
        self._move_feature(self.step)
        self.levels.set_film(self.solver.H0)
        self.film.values()
        return Storage(self.levels)

    def steps(self):
        """Generator of the following snapshots. The next march uses the tables of this one, and so its kernels, even if
        snapshots are kept.
        """
        for _ in range(self.step, total_steps(self.scene)):
            shot = self.advance()
            yield shot
            shot.let_go(keep=self.step == total_steps(self.scene))

    def advance(self):
        """Compute one time step; if it does not converge, in parts."""
        started, done, self.rejected = time.perf_counter(), 0.0, 0
        while done < 1.0:
            part = self.parts.next(done)
            report = self._try(done + part, part)
            if report.converged:
                done += part
            else:
                self._reject(report, part, done)
        self.step += 1
        return self._sound(self._describe(report, started))

    def _try(self, until, part):
        """Compute the state `until` steps from here, `part` of a step after the last accepted one; accept it if it
        converged.
        """
        H0, at = self.solver.H0, self._moved(self.step + until)
        self._move_feature(self.step + until)
        self.storage.begin(part * self.dT)
        self.prediction.put(at)
        report = self._exchange(part) if self.heat else self._solve()
        if report.converged:
            self._accept(at, part)
            self.parts.accept(part)
        else:
            self.solver.H0 = H0
        return report

    def _move_feature(self, step):
        gap = with_features(self.smooth, self.levels, self.scene.surfaces, self.position(step))
        sink(gap, self.levels, self.scene.surfaces, self.changes, self.position(step))
        self.levels.put(fields.GAP0, gap)

    def _exchange(self, part):
        """Solve pressure and temperatures of a part of a step."""
        self.heat.begin(part * self.dT * self.scales.t)
        return exchange(self.solver, self.heat, self._solve, sparing=True)

    def _solve(self):
        """Solve the pressure with film, cavitation, solid contact and load; with a safer method if it does not converge at
        once.
        """
        return carefully(self.solver, self.P)

    def _accept(self, at, part):
        """Accept the state in the tables as the newest one."""
        self.P = self.levels.get(fields.P)
        self.storage.accept(part * self.dT)
        self.prediction.accept(at)
        if self.heat:
            self.heat.accept()

    def _reject(self, report, part, done):
        self.rejected += 1
        if not self.parts.reject(part) and not self._double(done) and not self.parts.hold(self.heat):
            at = f"{position_word(self.scene)} at {self.position(self.step + 1):.2f} a"
            raise not_converged(self.solver, self.heat, report, f"step {self.step + 1} ({at}), down to {part:g} of it,",
                                passing=True)

    def _double(self, done):
        """Continue in double precision from the last accepted state, `done` of a step after the last whole one.

        Single precision is chosen by the smooth film, but a rough film may be on its floor. Returns False if the precision is
        already double, or the user's choice.
        """
        if self.levels.precision == "f64" or self.scene.numerics.precision != AUTO:
            return False
        state, self.doubled = self._accepted(), True
        self.levels = self.solver = self.heat = self.film = self.prediction = self.storage = None  # they give up their tables
        self._set_up(self.scene, state, done)
        return True

    def position(self, step):
        """Position of the first feature's centre, in units of a."""
        return self.first + step * self.step_x

    def _moved(self, step):
        """Number of cells that the features have moved after `step` steps."""
        return float(step * self.step_x / self.levels.dx)

    def _sound(self, shot):
        """Return the snapshot; raise if the surfaces cross at the border of the grid (there the pressure is given, not the
        gap).
        """
        if shot.fields["film"][self.border].min() < 0:
            raise crossed_surfaces(shot, self.scales.a, self.border)
        return shot

    def _describe(self, report, started):
        time_s = self.step * self.dT * self.scales.t
        X = self.position(self.step)
        solved = SolvedState(self.solver, self.heat, report, started, self.rejected, self.dT * self.scales.t, X)
        return snapshot.take(solved, self.step, time_s, X * self.scales.a,
                             functools.partial(self._state, self.step))

    def _state(self, step, carried=False):
        if step != self.step:
            snapshot.gone(step)
        if carried:
            return self.heat.carried()
        return {**self._accepted(), **self.parts.state(), **({"double": True} if self.doubled else {})}

    def _accepted(self):
        """Last accepted state, whatever the tables contain."""
        return {"step": self.step, "P": self.P, "H0": self.solver.H0, "load": self.solver.load,
                **(self.heat.state() if self.heat else {}),
                **self.storage.state(), **self.prediction.state()}
