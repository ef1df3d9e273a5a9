"""A snapshot: one accepted state of a run in SI units, with all that is needed to go on from it."""

import math
import time
from dataclasses import dataclass, field

import numpy as np

from tehl_taichi.kernels import fields, traction
from tehl_taichi.solvers.levels import load_weights
from tehl_taichi.solvers.steady import scalars


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


def take(solver, scene, step, time_s, feature_x, report, started):
    """Snapshot of what is in the solver's table; feature_x in m, started: time.perf_counter() when the step began."""
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
