"""Summary of a run, assembled from its store: the JSON object of `tehl run --json` (SI units in the names)."""

import numpy as np

from tehl_taichi import __version__
from tehl_taichi.fatigue import index_statistics, judged_surfaces
from tehl_taichi.fatigue.judged_layers import first_decides
from tehl_taichi.laws import conduction
from tehl_taichi.laws.law import beyond
from tehl_taichi.march import quantities
from tehl_taichi.march.accuracy.coarse_runs import FI, RUN_IN, distributions, indices, of_run_in, von_mises_parts
from tehl_taichi.runs.summary import life, result_warnings
from tehl_taichi.runs.summary.film_warnings import worst_ripple
from tehl_taichi.runs.summary.search_rows import nearest_to_yield
from tehl_taichi.scene import left_out, surface_roughness
from tehl_taichi.scene.film_formula import central_film, formula_words, spread
from tehl_taichi.scene.scales import Scales, peclet
from tehl_taichi.scene.scene_warnings import preview
from tehl_taichi.scene.timeline import total_steps
from tehl_taichi.store import attributes
from tehl_taichi.values.automatic import AutomaticValue
from tehl_taichi.values.coded_text import reasons_of, unknown_of
from tehl_taichi.values.coded_warning import lists


def summarise(store, extra, searches=None):
    """Summary dictionary of a run.

    extra: wall_s; compile_s (kernels traced, compiled or loaded); crowding (see :func:`tehl_taichi.engine.task_pool.crowding`,
    of this run; optional); steady_error, steady_unknown, steady_parts and steady_domain (see
    :class:`tehl_taichi.march.snapshot.Snapshot`); steady_contact_alone (see
    :func:`tehl_taichi.march.accuracy.contact_alone_bars.searches`); passage_error, passage_unknown and passage_parts;
    passage_sides (:func:`tehl_taichi.march.accuracy.side_change.side_change`); zoom (see
    :func:`tehl_taichi.runs.zoomed_run.summary`) and run_in (see :mod:`tehl_taichi.plastic.run_in_numbers`), both optional.
    searches: {surface: summary of its fatigue search}, or None.
    """
    scene = store.scene
    scales, zoom = Scales.of(scene), extra.get("zoom", {})
    out = {"scene": scene.name, "version": __version__, "store": str(store.path), "converged": True,
           "wall_s": extra["wall_s"], "compile_s": extra["compile_s"], "steps": int(store.series["step"][len(store) - 1]),
           **grid_counts(store),
           "hertz": _hertz(scales), **_peclet(scene, scales), "domain": {**domain_of(scene), **_sides(extra)},
           "left_out": left_out.parts(scene),
           "steady": _steady(store, extra)}
    out |= _roughness(scene, out["steady"])
    if len(store) > 1:
        out["transient"] = {**_transient(store), **{key: zoom[key] for key in zoom.get("base", {})}}
    elif alone := extra.get("steady_contact_alone"):
        worse = next(iter(alone))
        out["contact_alone"], out["contact_alone_by_surface"] = {"surface": worse, **alone[worse]}, alone
    if "run_in" in extra:
        out["run_in"] = extra["run_in"]
    known, unknown, of_it = (extra.get(f"passage_{what}", {}) for what in ("error", "unknown", "parts"))
    for part, names in _parts({**out, "fatigue_by_surface": searches or {}}):
        part["error"] = {name: known.get(bar) for name, bar in names.items()}
        part["error_parts"] = {name: of_it[bar] for name, bar in names.items() if bar in of_it}
        part |= unknown_of({name: unknown[bar] for name, bar in names.items() if bar in unknown})
    if searches:
        out |= judged_surfaces.parts(first_decides(searches))
    out |= {**_von_mises(out), **({"zoom": zoom} if zoom else {})}
    out |= life.part(out.get("fatigue_by_surface", {}), scene.fatigue)
    out["work"] = _work(store)
    out["crowding"] = extra.get("crowding", [0, 0])
    out["clamps"] = _clamps(store)
    found = result_warnings.warnings(store, out)
    out |= {**lists(found), "warnings": found}
    return out


def _von_mises(out):
    """Largest von Mises stress of the body nearest to its yield stress, if stresses were searched."""
    searches = out.get("fatigue_by_surface") or out.get("contact_alone_by_surface", {})
    worst = nearest_to_yield(searches.values())
    return {"von_mises": dict(worst)} if worst else {}


def _peclet(scene, scales):
    """Peclet numbers u a/alpha of both surfaces, if temperatures are computed."""
    o = scene.operation
    each = (("a", scene.body_a, o.u_a), ("b", scene.body_b, o.u_b))
    return {} if scene.isothermal else {"peclet": {name: peclet(body, u, scales) for name, body, u in each}}


def unfinished_summary(store):
    """JSON object of a run without a summary: not finished, or still being written."""
    return {"scene": store.scene.name, "version": attributes.text(store.attrs, "version"), "store": str(store.path),
            "finished": False, "written_by": store.writer, "steps": store.last_step, **_run_in_so_far(store),
            **grid_counts(store),
            "left_out": store.scene.left_out(), "warnings": store.warnings}


def planned_summary(scene):
    """JSON object of `tehl run --dry-run --json`: what is known about a run before it starts."""
    found = scene.warnings()
    return {"scene": scene.name, "version": __version__, "dry_run": True, "steps": total_steps(scene), "cells": _cells(scene),
            "hertz": _hertz(Scales.of(scene)), "domain": domain_of(scene), "left_out": scene.left_out(),
            "steady": _film_formula(scene), "preview": preview(scene), **lists(found)}


def _run_in_so_far(store):
    """Completed passages of the run-in, and rounds of the current one."""
    state = store.run_in
    return {"run_in": {"passages": state.passages, "rounds": state.rounds, "done": state.done}} if state else {}


def grid_counts(store):
    """Counts. grid: computed nodes, nz of them across the film; cells: as in [grid] and --grid.

    ny cells are those of the half domain y >= 0 (the whole domain has 2 ny + 1 nodes); 0 without variation along y (one row of
    nodes).
    """
    scene = store.scene
    return {"grid": {"nx": store.x.size, "ny": store.y.size, "nz": 1 if scene.isothermal else scene.thermal.nodes},
            "cells": _cells(scene)}


def _cells(scene):
    return {"nx": scene.grid.nx, "ny": 0 if scene.one_dimensional else scene.grid.ny}


def domain_of(scene):
    """Ends of the domain in half-widths of the contact, and whether the program chose the inlet."""
    g = scene.grid
    ends = {"x_min_a": float(g.x_min), "x_max_a": float(g.x_max), "y_max_b": float(g.y_max)}
    return {**ends, "auto": isinstance(g.x_min, AutomaticValue)}


def _sides(extra):
    """Change of the film at the sides of the domain, if features cause any."""
    return {"side_change": extra["passage_sides"]} if extra.get("passage_sides") else {}


def _clamps(store):
    """Laws outside their measured range and held values: {name: count or largest value}."""
    if store.scene.isothermal:
        return {}
    held = int(np.nansum(store.scalar("clamped")))
    return {**beyond(conduction.LAWS, *result_warnings.reached_maxima(store)),
            **({"temperatures limited to the allowed range": held} if held else {})}


def _hertz(scales):
    """Half-axes and pressure of the dry contact; b along y for point contacts."""
    across = {} if scales.line else {"b_m": scales.b}
    return {"a_m": scales.a, **across, "p_Pa": scales.p_H}


def _steady(store, extra):
    out = {**_numbers(store, "steady"), "ripple_Pa": worst_ripple(store, [0])[0][0], **_film_formula(store.scene)}
    out["error"], out["error_parts"] = extra["steady_error"], extra.get("steady_parts", {})
    reasons = {"unknown": extra.get("steady_unknown", {}), "unknown_codes": extra.get("steady_unknown_codes", {})}
    return {**out, **unknown_of(reasons_of(reasons)), **_ends(extra.get("steady_domain", {}))}


def _film_formula(scene):
    """Central film by formula, its name and its uncertainty."""
    return {"film_formula_m": central_film(scene), "film_formula": formula_words(scene), "film_formula_spread": spread(scene)}


def _ends(known):
    """Numbers of the ends along x: gap over film at the inlet, the film reduction by a border without pressure there, and the
    slope of the pressure at an outlet before the rupture of the film (p_max per a).
    """
    slope = {"outlet_slope": known["cut"]} if known.get("cut") else {}
    return {"inlet_gap": known["gap"], "inlet_lost": known["lost"], **slope} if known else {}


def _roughness(scene, steady):
    """Numbers of the rough surfaces, and lambda: central film of the smooth contact over the combined rms height."""
    found = surface_roughness.by_surface(scene)
    if not found:
        return {}
    Sq, error = surface_roughness.combined(found)[0], steady["error"].get("h_c_m")
    out = {"roughness": surface_roughness.to_dict(scene)}
    if Sq > 0:
        out |= {"lambda": steady["h_c_m"] / Sq, "error": {"lambda": None if error is None else error / Sq}}
    return out


def _parts(out):
    """[(part of the summary, {number with an error bar: its name among the errors})]."""
    parts = [(out.get("transient"), {entry.key: entry.key for entry in quantities.of_part("transient") if entry.error}),
             (out.get("run_in"), {key: of_run_in(key) for key in RUN_IN}),
             *((part, {FI: name}) for name, part in indices(out.get("fatigue_by_surface", {})).items()),
             *((part, {"max_Pa": name}) for name, part in von_mises_parts(out.get("fatigue_by_surface", {})).items()),
             *((part, {key: f"{name}.{key}" for key in index_statistics.NUMBERS})
               for name, part in distributions(out.get("fatigue_by_surface", {})))]
    return [(part, {name: bar for name, bar in names.items() if name in part}) for part, names in parts if part]


def _transient(store):
    return {**_numbers(store, "transient"), "ripple_max_Pa": worst_ripple(store, range(1, len(store)))[0][0]}


def _numbers(store, part):
    """{key: value} of the numbers of a part declared in :mod:`tehl_taichi.march.quantities`."""
    return {entry.key: entry.of(store.scalar(entry.series), _steps_of(store))
            for entry in quantities.of_part(part, store.scene)}


def _steps_of(store):
    """Number of time steps that every entry after the first represents."""
    return np.diff(store.scalar("step"))


def _work(store):
    cycles = store.scalar("cycles")
    worst = int(np.ceil(np.max(cycles[1:] / _steps_of(store)))) if len(store) > 1 else 0  # with output.every: of their means
    return {"pressure_cycles": int(cycles.sum()), "cycles_per_step_max": worst,
            "newton_steps": int(store.scalar("newton").sum()), "rejected_steps": int(store.scalar("rejected").sum())}
