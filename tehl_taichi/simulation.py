"""The passage of a feature through the contact: steady start, then a march in time that yields snapshots.

A time step: move the feature, predict the pressure, solve film + cavitation + contact + load, accept.
"""

import math
import time
from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.kernels import fields, traction
from tehl_taichi.physics.gap import feature_height
from tehl_taichi.scene.scales import Scales
from tehl_taichi.solvers.levels import Levels, load_weights
from tehl_taichi.solvers.newton import PressureSolver
from tehl_taichi.solvers.steady import scalars, solve_steady

# Feature position (in a) up to which the pressure is extrapolated in the frame of the feature, later in the frame of the
# contact. Newton / Krylov per step (gear, dent, touching asperity; 256x64): not extrapolated, moved along up to 0.3
# 3.28/21.5, 2.99/20.4, 4.73/33.3; contact frame only 3.20/19.0, 2.97/17.9, 3.88/24.9; switch at -0.2 2.96/18.2, 2.67/17.6,
# 3.58/23.2, at 0.3 3.06/19.4 (gear), at 0.8 3.60/25.4; the frame that was nearer one step ago 2.99/18.9, 2.67/17.8, 3.74/25.0
SHIFT_UNTIL = -0.2
RETRY_KRYLOV = 3e-3  # a failed step is repeated from the old pressure with a Krylov solve ten times tighter


class NotConverged(RuntimeError):
    """A step did not converge; the message says where, why and what to try. Earlier snapshots are good."""


@dataclass
class Snapshot:
    """One accepted state.

    step: 0 = steady start; time s; feature_x m, centre of the first feature (nan without one); x (nx+1,), y (ny+1,) m;
    fields: (nx+1, ny+1) arrays in SI; scalars: numbers in SI; state: all that is needed to go on (f64);
    error: estimated discretisation error of h_c_m, h_min_m, p_max_Pa (steady start only).
    """

    step: int
    time: float
    feature_x: float
    x: np.ndarray
    y: np.ndarray
    fields: dict
    scalars: dict
    state: dict
    error: dict = field(default_factory=dict)


def total_steps(scene):
    """Number of time steps after the steady start (0 for a steady scene)."""
    if not scene.transient:
        return 0
    t, g = scene.time, scene.grid
    cell = (g.x_max - g.x_min) / g.nx
    steps = math.ceil((t.x_end - t.x_start) / (t.courant * cell) - 1e-9)
    return min(steps, t.steps) if t.steps else steps


def march(scene, state=None):
    """Yield a Snapshot per time step, from the steady start or after the snapshot whose `state` is given.

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
    ny = 0 if scales.kind == "line" else scene.grid.ny
    result = solve_steady(scene, scales, scene.grid.nx, ny)
    if not result.report.converged:
        raise NotConverged(_reason(result.solver, result.report, "the steady start"))
    snapshot = _snapshot(result.solver, scene, 0, 0.0, math.nan, result.report, started)
    snapshot.scalars["cycles"] = float(result.work)
    units = {"h_c": ("h_c_m", scales.h), "h_min": ("h_min_m", scales.h), "p_max": ("p_max_Pa", scales.p_H)}
    snapshot.error = {units[key][0]: value * units[key][1] for key, value in result.errors().items()}
    return _spread(snapshot, scene, scales), result.solver


def _spread(snapshot, scene, scales):
    """A one-dimensional start copied to every y row when the scene goes on in two dimensions."""
    if snapshot.y.size > 1 or not scene.transient:
        return snapshot
    rows = scene.grid.ny + 1
    snapshot.y = np.linspace(0.0, scene.grid.y_max, rows) * scales.a
    snapshot.fields = {key: np.repeat(value, rows, axis=1) for key, value in snapshot.fields.items()}
    snapshot.feature_x = scene.time.x_start * scales.a
    snapshot.state["P"] = np.tile(snapshot.state["P"], (rows, 1))
    return snapshot


class Passage:
    """The march in time from a saved state."""

    def __init__(self, scene, scales, state):
        self.scene, self.scales = scene, scales
        self.solver = PressureSolver(Levels(scene, scales, scene.grid.nx, scene.grid.ny))
        self.levels = self.solver.levels
        self.step_x = scene.time.courant * self.levels.dx
        self.dT = self.step_x * scene.operation.u_m / scene.operation.u_a
        self.step, self.P = int(state["step"]), np.array(state["P"])
        self.solver.H0 = float(state["H0"])
        self.P_before, self.mass, self.mass_before = (state.get(key) for key in ("P_before", "mass", "mass_before"))

    def steps(self):
        """Generator of the snapshots that follow."""
        if self.mass is None:
            self._start()
        for _ in range(self.step, total_steps(self.scene)):
            yield self.advance()

    def advance(self):
        """One time step."""
        started = time.perf_counter()
        self._move_feature(self.step + 1)
        self._discretise_time()
        self._predict()
        report, rejected = self._solve()
        self._accept()
        return self._describe(report, rejected, started)

    def position(self, step):
        """Centre of the first feature in units of a."""
        return self.scene.time.x_start + step * self.step_x

    def _start(self):
        self._move_feature(0)
        self.levels.put(fields.P, self.P)
        self.levels.set_film(self.solver.H0)
        self.levels.laws()
        self.mass = self._mass()

    def _move_feature(self, step):
        v, s = self.levels, self.scales
        X, Y = v.X[None, :], v.Y[:, None]
        gap = 0.5 * X**2 + (0.5 * Y**2 if v.kind == "point" else 0 * Y)
        for feature in self.scene.features:
            x = (X - self.position(step)) * s.a - feature.x
            gap = gap - feature_height(feature, x, (Y * s.a - feature.y)) / s.h
        v.put(fields.GAP0, gap)

    def _discretise_time(self):
        """BDF2; the very first step is BDF1."""
        v = self.levels
        if self.mass_before is None:
            weight, old = 1 / self.dT, -self.mass / self.dT
        else:
            weight, old = 1.5 / self.dT, (-2 * self.mass + 0.5 * self.mass_before) / self.dT
        v.set_rate(weight)
        v.put(fields.QOLD, old * v.dx)

    def _predict(self):
        P = self.P
        if self.P_before is not None:
            moves = self.position(self.step + 1) < SHIFT_UNTIL
            P = np.maximum(_extrapolated(P, self.P_before, self.step_x / self.levels.dx if moves else 0.0), 0.0)
            P[:, [0, -1]] = 0.0
        self.levels.put(fields.P, P)

    def _solve(self):
        H0 = self.solver.H0
        report = self.solver.solve()
        if report.converged:
            return report, 0
        self.levels.put(fields.P, self.P)
        self.solver.H0 = H0
        report = self.solver.solve(RETRY_KRYLOV, newton_max=2 * self.scene.numerics.newton_max)
        if not report.converged:
            where = f"step {self.step + 1} (feature at {self.position(self.step + 1):.2f} a)"
            raise NotConverged(_reason(self.solver, report, where))
        return report, 1

    def _accept(self):
        self.step += 1
        self.P_before, self.P = self.P, self.levels.get(fields.P)
        self.mass_before, self.mass = self.mass, self._mass()

    def _mass(self):
        v = self.levels
        return v.get(fields.RHO) * v.get(fields.H)

    def _describe(self, report, rejected, started):
        time_s = self.step * self.dT * self.scales.t
        snapshot = _snapshot(self.solver, self.scene, self.step, time_s, self.position(self.step) * self.scales.a,
                             report, started)
        snapshot.scalars.update(rejected=float(rejected), dt_s=self.dT * self.scales.t)
        snapshot.state.update(P_before=self.P_before, mass=self.mass, mass_before=self.mass_before)
        return snapshot


def _extrapolated(P, P_before, cells):
    """The next pressure from the last two (ny+1, nx+1) in a frame in which what differs from the outermost row moves
    by `cells` a step."""
    edge, edge_before = P[-1:], P_before[-1:]
    inner = 2 * (P - edge) - _shift(P_before - edge_before, cells)
    return 2 * edge - edge_before + _shift(inner, cells)


def _shift(field_, cells):
    """Field moved by `cells` (not whole numbers only) towards +x, zeros coming in."""
    whole = int(math.floor(cells + 1e-9))
    part = max(cells - whole, 0.0)
    return (1 - part) * _roll(field_, whole) + part * _roll(field_, whole + 1)


def _roll(field_, cells):
    out = np.zeros_like(field_)
    out[:, cells:] = field_[:, : field_.shape[1] - cells]
    return out


def _reason(solver, report, where):
    v = solver.levels
    i, j = solver.worst()
    return (f"{where} did not converge: residual {report.residual:.1e} (tolerance {v.scene.numerics.tolerance:.0e}), "
            f"largest at X = {v.X[i]:.2f}, Y = {v.Y[j]:.2f}; try a finer grid (--grid) or a smaller time.courant")


def _snapshot(solver, scene, step, time_s, feature_x, report, started):
    v, s = solver.levels, solver.levels.scales
    P, H, touch = (v.get(row) for row in (fields.P, fields.H, fields.TOUCH))
    stress = _tractions(solver, scene)
    si = {"pressure": P * s.p_H, "film": H * s.h, "contact": touch.astype(np.uint8)}
    names = ("traction_x_a", "traction_y_a", "traction_x_b", "traction_y_b")
    si.update(zip(names, stress))
    numbers = _scalars(solver, report, stress)
    numbers["wall_s"] = time.perf_counter() - started
    state = {"step": step, "P": P, "H0": solver.H0}
    return Snapshot(step, time_s, feature_x, v.X * s.a, v.Y * s.a,
                    {key: np.ascontiguousarray(value.T) for key, value in si.items()}, numbers, state)


def _tractions(solver, scene):
    v, s = solver.levels, solver.levels.scales
    out = np.zeros((4, v.ny + 1, v.nx + 1))
    traction.tractions(v.S, v.G, scene.rheology, s.p_H, s.h, s.a, math.exp(v.ln_eta0), scene.operation.u_s, v.dx, v.dy,
                       out)
    return out


def _scalars(solver, report, stress):
    v, s, w = solver.levels, solver.levels.scales, load_weights(solver.levels)
    values = scalars(solver)
    P, touch = v.get(fields.P), v.get(fields.TOUCH)
    drag = 0.5 * abs(float(np.sum(w * (stress[0] - stress[2]))))
    return {"h0_m": solver.H0 * s.h, "p_max_Pa": values["p_max"] * s.p_H, "h_min_m": values["h_min"] * s.h,
            "h_c_m": values["h_c"] * s.h, "load_error": abs(report.load_error), "mass_error": report.mass_error,
            "residual": report.residual, "newton": float(report.newton), "cycles": float(report.cycles),
            "rejected": 0.0, "dt_s": 0.0, "contact_load_fraction": float(np.sum(w * P * touch)) / solver.load,
            "friction_coefficient": drag / s.p_H / solver.load}
