"""The passage of a feature through the contact: steady start, then a march in time that yields snapshots.

A time step: move the feature, predict the pressure, solve film + cavitation + contact + load, accept.
"""

import functools
import math
import time

import numpy as np

from tehl_taichi.errors import NotConverged
from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march import readings, snapshot
from tehl_taichi.march.error_bars import bars
from tehl_taichi.march.guess import Guess, extrapolated
from tehl_taichi.march.snapshot import Snapshot
from tehl_taichi.march.solved import Solved
from tehl_taichi.march.steady import solve_steady
from tehl_taichi.physics.gap import feature_height
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.newton import PressureSolver
from tehl_taichi.pressure.storage import Storage
from tehl_taichi.scene.route import step_cells, total_steps
from tehl_taichi.scene.scales import Scales

__all__ = ["NotConverged", "Passage", "Snapshot", "march", "total_steps"]

ORDER, HEAT_ORDER = 3, 1  # of the extrapolation in time of pressure and temperatures
SLUGGISH = 0.2  # rounds of pressure and temperature that leave more of the last change are relaxed; usual is 0.01 to 0.1
RETRY_KRYLOV = 3e-3  # a failed step is repeated from the old pressure with a Krylov solve ten times tighter,
SMALLEST_PART = 1 / 16  # then in halves down to this part of it; after that parts at most double


def march(scene, state=None):
    """Yield a Snapshot per time step, from the steady start or after the snapshot whose `state` is given (to be taken from it
    before the next one is asked for).

    Raises NotConverged when a step fails for good. The same state gives the same following steps, bit for bit.
    """
    scales = Scales.of(scene)
    if state is None:
        first, solver = _steady_snapshot(scene, scales)
        yield first
        state = first.state
        del solver
    if total_steps(scene) > state["step"]:
        yield from Passage(scene, scales, state).steps()


def _steady_snapshot(scene, scales):
    started = time.perf_counter()

    def look(solver, heat, report):
        solved = Solved(solver, heat, report, started)
        return readings.steady(snapshot.take(solved, 0, 0.0, math.nan, None)) if report.converged else None

    result = solve_steady(scene, scales, scene.grid.nx, 0 if scales.line else scene.grid.ny, look)
    if not result.report.converged:
        raise NotConverged(_reason(result.solver, result.heat, result.report, "the steady start"))
    state = snapshot.state_of(result.solver, result.heat, 0)
    solved = Solved(result.solver, result.heat, result.report, started)
    first = snapshot.take(solved, 0, 0.0, math.nan, lambda: state)
    first.scalars["cycles"] = float(result.work)
    first.grids, (first.error, first.unknown) = result.values, bars(result.values)
    return _spread(first, scene, scales), result.solver


def _spread(first, scene, scales):
    """The smooth start on the rows of the passage: a line copied to every row, a half mirrored to the whole."""
    if scene.transient:
        first.feature_x = scene.path[0] * scales.a
    rows = scene.rows + 1 if scene.transient else first.y.size
    if first.y.size == rows:
        return first
    if first.y.size == 1:
        extent = scene.grid.y_max * scales.b
        first.y = np.linspace(0.0 if scene.symmetric else -extent, extent, rows)
        across = np.zeros(rows, int)
    else:
        first.y = np.concatenate([-first.y[:0:-1], first.y])
        across = np.abs(np.arange(rows) - scene.grid.ny)
    first.fields = {key: np.ascontiguousarray(value[:, across]) for key, value in first.fields.items()}
    for key, value in first.state.items():
        if key == "P" or key in FilmHeat.FIELDS:
            first.state[key] = np.ascontiguousarray(value[..., across, :])
    return first


class Passage:
    """The march in time from a saved state."""

    def __init__(self, scene, scales, state):
        self.scene, self.scales = scene, scales
        self.solver = PressureSolver(Levels(scene, scales, scene.grid.nx, scene.rows, full=not scene.symmetric))
        self.levels = self.solver.levels
        self.smooth = self.levels.smooth_gap()
        self.step_x = step_cells(scene) * self.levels.dx
        self.dT = self.step_x * scene.operation.u_m / scene.operation.u_a
        self.step, self.P, self.solver.H0 = int(state["step"]), np.array(state["P"]), float(state["H0"])
        self.part = float(state.get("part", 1.0))
        self.guess = Guess(ORDER, self.P, self._moved(self.step), state, "P")
        self.heights = list(state.get("H0_history", [self.solver.H0]))  # at the positions of the guess
        self.storage = Storage(self.levels, state) if "mass" in state else None
        self.heat = None if scene.isothermal else self._heat(state)

    def _heat(self, state):
        heat = FilmHeat(self.levels, self.dT * self.scales.t)
        self.levels.use_film(*heat.laws)
        self.levels.put(fields.P, self.P)
        heat.restore(state)
        self.heat_guess = Guess(HEAT_ORDER, heat.T, self._moved(self.step), state, "T")
        return heat

    def steps(self):
        """Generator of the snapshots that follow."""
        if self.storage is None:
            self._start()
        for _ in range(self.step, total_steps(self.scene)):
            yield self.advance()

    def advance(self):
        """One time step; where it does not converge, in parts."""
        started, done, self.rejected = time.perf_counter(), 0.0, 0
        part = min(1.0, 2 * self.part)
        while done < 1.0:
            report = self._try(done + part, part)
            if report.converged:
                done += part
                part = min(1.0 - done, 2 * part)
            else:
                part = self._shorter(report, part)
        self.step += 1
        return self._describe(report, started)

    def _try(self, until, part):
        """Solve at `until` steps from here, `part` of a step after the last accepted state; accepted if it converged."""
        H0, at = self.solver.H0, self._moved(self.step + until)
        self._move_feature(self.step + until)
        self.storage.begin(part * self.dT)
        self._predict(at)
        report = self._exchange(part) if self.heat else self._solve()
        if report.converged:
            self._accept(at, part)
        else:
            self.solver.H0 = H0
        return report

    def _exchange(self, part):
        """Temperature and pressure by turns until another round would change the temperature by less than thermal.tolerance.

        The first round takes one Newton step only: its pressure belongs to guessed temperatures anyway.
        """
        thermal, newton, cycles, change = self.scene.thermal, 0, 0, math.inf
        self.heat.begin(part * self.dT * self.scales.t)
        for turn in range(thermal.rounds):
            first = turn == 0 and thermal.rounds > 1
            report = self.solver.improve() if first else self._solve()
            newton, cycles = newton + report.newton, cycles + report.cycles
            if not (first or report.converged):
                break
            heat, before = self.heat.solve(), change
            change = heat.change
            if thermal.rounds > 1:  # they contract: the next one changes about as much less as this one did
                heat.change *= min(change / before, 1.0)
            settled = heat.change < thermal.tolerance and not heat.failed
            if not first and (settled or thermal.rounds == 1):
                break
            if change > SLUGGISH * before:
                self.heat.relax()
        else:
            report.converged = False
        report.newton, report.cycles = newton, cycles
        return report

    def _shorter(self, report, part):
        self.rejected += 1
        if part / 2 < SMALLEST_PART:
            where = f"step {self.step + 1} (feature at {self.position(self.step + 1):.2f} a), down to {part:g} of it,"
            raise NotConverged(_reason(self.solver, self.heat, report, where))
        return part / 2

    def position(self, step):
        """Centre of the first feature in units of a."""
        return self.scene.path[0] + step * self.step_x

    def _moved(self, step):
        """Cells that the features have moved after so many steps."""
        return float(step * self.step_x / self.levels.dx)

    def _start(self):
        self._move_feature(0)
        self.levels.put(fields.P, self.P)
        self.levels.set_film(self.solver.H0)
        self.levels.laws()
        self.storage = Storage(self.levels)

    def _move_feature(self, step):
        v, s, gap = self.levels, self.scales, self.smooth.copy()
        for feature in self.scene.features:
            x, y = (v.X - self.position(step)) * s.a - feature.x, v.Y[:, None] * s.a - feature.y
            under = np.abs(x) <= feature.reach
            if feature.transverse:  # cheap, and a ridge does not quite end
                under, y = slice(None), y[:1]
            gap[:, under] -= feature_height(feature, x[under], y) / s.h
        v.put(fields.GAP0, gap)

    def _predict(self, at):
        """Start values for the state with the feature `at` cells from its start."""
        P = np.maximum(self.guess.next(at), 0.0)
        P[:, [0, -1]] = 0.0
        self.levels.put(fields.P, P)
        self.solver.H0 = extrapolated(self.heights[: ORDER + 1], self.guess.at, at)
        if self.heat:
            T = self.heat_guess.next(at)
            self.heat.set_temperature(np.clip(T, self.heat.T.min(), self.heat.T.max() + 20.0))

    def _solve(self):
        H0 = self.solver.H0
        report = self.solver.solve()
        if not report.converged:
            self.levels.put(fields.P, self.P)
            self.solver.H0 = H0
            report = self.solver.solve(RETRY_KRYLOV, newton_max=2 * self.scene.numerics.newton_max)
        return report

    def _accept(self, at, part):
        self.P, self.part = self.levels.get(fields.P), part
        self.guess.accept(self.P, at)
        self.heights = [self.solver.H0, *self.heights[:ORDER]]
        self.storage.accept(part * self.dT)
        if self.heat:
            self.heat.accept()
            self.heat_guess.accept(self.heat.T, at)

    def _describe(self, report, started):
        time_s = self.step * self.dT * self.scales.t
        solved = Solved(self.solver, self.heat, report, started, self.rejected, self.dT * self.scales.t)
        return snapshot.take(solved, self.step, time_s, self.position(self.step) * self.scales.a,
                             functools.partial(self._state, self.step))

    def _state(self, step):
        if step != self.step:
            raise RuntimeError(f"the state of step {step} is gone: ask for it before the next step is computed")
        guesses = {**self.guess.state(), "H0_history": np.array(self.heights), **(self.heat_guess.state() if self.heat else {})}
        return {**snapshot.state_of(self.solver, self.heat, step), **self.storage.state(), **guesses, "part": self.part}


def _reason(solver, heat, report, where):
    v, tolerance = solver.levels, solver.levels.scene.numerics.tolerance
    double = "" if v.precision == "f64" else ", --precision f64"
    if heat and report.residual < tolerance:
        return (f"{where} did not converge: the temperatures still change by {heat.report.change:.2g} K from round to round; "
                f"try a finer grid (--grid), a smaller time.courant{double} or --isothermal")
    i, j = solver.worst()
    return (f"{where} did not converge: residual {report.residual:.1e} (tolerance {tolerance:.0e}), "
            f"largest at X = {v.X[i]:.2f}, Y = {v.Y[j]:.2f}; try a finer grid (--grid){double} or a smaller time.courant")
