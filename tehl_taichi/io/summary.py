"""The summary of a run, assembled from its store: the JSON object of `tehl run --json` (SI units in the names)."""

import numpy as np

from tehl_taichi import __version__
from tehl_taichi.io import judge
from tehl_taichi.physics.formula import central_film
from tehl_taichi.physics.limits import GAMMA_MEASURED, P_MEASURED
from tehl_taichi.scene.scales import Scales


def summarise(store, extra, fatigue=None):
    """Summary dictionary. extra: wall_s, compile_s (kernels traced, compiled or loaded) and steady_error; fatigue: its own
    dictionary or None."""
    scene = store.scene
    scales = Scales.of(scene)
    out = {"scene": scene.name, "version": __version__, "store": str(store.path), "converged": True,
           "wall_s": extra["wall_s"], "compile_s": extra["compile_s"], "steps": int(store.series["step"][len(store) - 1]),
           "grid": {"nx": store.x.size, "ny": store.y.size, "nz": 1 if scene.isothermal else scene.thermal.nodes},
           "hertz": {"a_m": scales.a, "p_Pa": scales.p_H}, "left_out": scene.left_out(),
           "steady": _steady(store, extra["steady_error"])}
    if len(store) > 1:
        out["transient"] = _transient(store)
    if fatigue:
        out["fatigue"] = fatigue
    if extra.get("passage_error"):
        _add_errors(out, extra["passage_error"])
    out["work"] = _work(store)
    out["clamps"] = _clamps(store)
    out["warnings"] = judge.warnings(store, out)
    return out


HEAT = ("film_max_C", "surface_a_max_C", "surface_b_max_C")


def _clamps(store):
    """Where laws left their measured range or values were held: {what: count or largest value}."""
    scene, out = store.scene, {}
    if scene.isothermal:
        return out
    p, T = float(np.max(store.scalar("p_max_Pa"))), float(np.max(store.scalar("film_max_C")))
    if p > P_MEASURED:
        out["conductivity and heat capacity measured up to Pa"] = P_MEASURED
    if T > GAMMA_MEASURED:
        out["heat capacity measured up to degC"] = GAMMA_MEASURED
    held = int(np.nansum(store.scalar("clamped")))
    if held:
        out["temperatures held inside the allowed range"] = held
    return out


def _steady(store, error):
    names = ["h_c_m", "h_min_m", "p_max_Pa", "load_error", "mass_error", "friction_coefficient"]
    names += [] if store.scene.isothermal else HEAT
    out = {name: float(store.scalar(name)[0]) for name in names}
    out["film_formula_m"] = central_film(store.scene)
    out["error"] = error
    return out


def passage_values(store, fatigue):
    """The numbers of a stored passage whose errors companion runs can tell, as those give them."""
    from tehl_taichi.post.estimate import PASSAGE

    transient = _transient(store)
    names = [name for name in PASSAGE if name in transient]
    return {**{name: transient[name] for name in names}, **({"Fi_max": fatigue["Fi_max"]} if fatigue else {})}


def _add_errors(out, errors):
    out["transient"]["error"] = {name: value for name, value in errors.items() if name != "Fi_max"}
    if "fatigue" in out:
        out["fatigue"]["error"] = {"Fi_max": errors["Fi_max"]}


def _transient(store):
    def largest(name):
        return float(np.max(store.scalar(name)[1:]))

    heat = {} if store.scene.isothermal else {name: largest(name) for name in (*HEAT, "temperature_change_K")}
    return {**heat, "p_max_Pa": largest("p_max_Pa"), "h_min_m": float(np.min(store.scalar("h_min_m")[1:])),
            "contact_load_fraction_max": largest("contact_load_fraction"), "load_error_max": largest("load_error"),
            "mass_error_max": largest("mass_error"), "residual_max": largest("residual"), "dt_s": largest("dt_s"),
            "friction_coefficient_mean": float(np.mean(store.scalar("friction_coefficient")[1:]))}


def _work(store):
    cycles = store.scalar("cycles")
    return {"pressure_cycles": int(cycles.sum()), "cycles_per_step_max": int(cycles[1:].max()) if len(store) > 1 else 0,
            "newton_steps": int(store.scalar("newton").sum()), "rejected_steps": int(store.scalar("rejected").sum())}
