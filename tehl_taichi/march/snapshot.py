"""A snapshot: one accepted state of a run in SI units; while it is the newest, all that is needed to go on from it."""

import functools
import time
from dataclasses import dataclass, field
from typing import Callable

import numpy as np

from tehl_taichi.heat.across import largest
from tehl_taichi.march.steady import scalars
from tehl_taichi.pressure import fields, tractions
from tehl_taichi.pressure.levels import load_weights


@dataclass
class Snapshot:
    """One accepted state.

    step: 0 = steady start; time s; feature_x m, centre of the first feature (nan without one); x (nx+1,), y (ny+1,) m;
    fields: (nx+1, ny+1) arrays in SI; scalars: numbers in SI; make_state: called for
    :attr:`state`. Of a steady start, grids: {name: Reading} of every grid that it visited, error: bars of its numbers (None
    where they are not known), unknown: why they are not.
    """

    step: int
    time: float
    feature_x: float
    x: np.ndarray
    y: np.ndarray
    fields: dict
    scalars: dict
    make_state: Callable[[], dict]
    grids: list = field(default_factory=list)
    error: dict = field(default_factory=dict)
    unknown: dict = field(default_factory=dict)

    @functools.cached_property
    def state(self):
        """All that is needed to go on (f64, large). Ask for it before the next snapshot is computed: RuntimeError later."""
        return self.make_state()


def take(solver, heat, step, time_s, feature_x, report, started, make_state):
    """Snapshot of what is in the solver's table; heat: its FilmHeat or None; feature_x in m, started: time.perf_counter()
    when the step began; make_state: see :class:`Snapshot`."""
    v, s = solver.levels, solver.levels.scales
    P, H, touch = (v.get(row) for row in (fields.P, fields.H, fields.TOUCH))
    stress = _tractions(solver, heat)
    si = {"pressure": P * s.p_H, "film": H * s.h, "contact": touch.astype(np.uint8)}
    names = ("traction_x_a", "traction_y_a", "traction_x_b", "traction_y_b")
    si.update(zip(names, stress))
    numbers = _scalars(solver, report, stress)
    if heat:
        si.update(_temperatures(heat, solver.levels.scene.output.profiles))
        numbers.update(film_max_C=largest(heat.T), surface_a_max_C=float(si["temperature_a"].max()),
                       surface_b_max_C=float(si["temperature_b"].max()), temperature_change_K=heat.report.change,
                       clamped=float(heat.report.clamped))
    numbers["wall_s"] = time.perf_counter() - started
    return Snapshot(step, time_s, feature_x, v.X * s.a, v.Y * s.a,
                    {key: np.ascontiguousarray(value.swapaxes(0, 1)) for key, value in si.items()}, numbers, make_state)


def state_of(solver, heat, step):
    """What is in the solver's table, as arrays to go on from."""
    return {"step": step, "P": solver.levels.get(fields.P), "H0": solver.H0, **(heat.state() if heat else {})}


def _temperatures(heat, profiles):
    T = heat.T
    out = {"temperature_mid": T[len(T) // 2], "temperature_a": T[0], "temperature_b": T[-1]}
    return {**out, "temperature": T.transpose(1, 2, 0)} if profiles else out


def _tractions(solver, heat):
    """Shear (4, ny+1, nx+1) in Pa on body a along x, y and on body b along x, y."""
    v = solver.levels
    out = v.fill(tractions.tractions, (4, v.ny + 1, v.nx + 1), v.scene.rheology, v.conditions.values)
    if heat:
        wall, film = heat.shear(), (v.get(fields.P) > 0) & (v.get(fields.TOUCH) == 0)
        out = np.where(film, wall * np.array([1, 1, -1, -1])[:, None, None], out)
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
