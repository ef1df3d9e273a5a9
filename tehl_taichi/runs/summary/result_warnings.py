"""Warnings about the results of a run, one sentence each: warnings of the scene, and those from its store."""

import functools
import re

import numpy as np

from tehl_taichi.fatigue.judged_layers import deciding, judged_point, judged_points, over
from tehl_taichi.fatigue.judged_surfaces import by_surface, others
from tehl_taichi.fatigue.pressure_alone import searched, why_none
from tehl_taichi.laws import conduction
from tehl_taichi.laws.law import beyond
from tehl_taichi.march.accuracy.coarse_runs import near_the_surface
from tehl_taichi.march.quantities import short_name
from tehl_taichi.runs.summary import domain_warnings, film_warnings, rim_warnings
from tehl_taichi.runs.summary.summary_row import quantity
from tehl_taichi.scene import yield_stress
from tehl_taichi.scene.refinement import finer_grid_option, zoom_option
from tehl_taichi.values.coded_text import Option, Reason, reasons_of
from tehl_taichi.values.coded_warning import coded_warning, unique, with_data
from tehl_taichi.values.digits import micrometres, number_of, with_error
from tehl_taichi.values.summary_values import error_of

STILL = 0.01  # of the largest plastic strain: a passage that adds less has run in
ABOVE = 0.03  # of the largest pressure of a run: a window with so much more would make more steel flow
OF_USER = "idle", "replaced"  # codes of warnings about what the user typed, which the scene of a store no longer knows
MANY, FIRST = 6, 4  # numbers without an error bar: so many are all named, of more the first
FEWER = Option("use fewer --threads", "use fewer threads")
CROWDED = 0.1  # of the launches; a machine of one's own loses a core for a moment now and then, which costs nothing to speak of


def warnings(store, summary):
    """All warnings of a run, without repetition: a computed number replaces the scene's estimate of its kind.

    store: of the run; summary: its numbers so far.
    """
    checks = ROUGH_CHECKS if searched(summary.get("fatigue", {})).get("rough") else CHECKS
    found = coded_warning(checks, store, summary)
    kinds = {one.code for one in found}
    at_start = [one for one in store.warnings if one.code in OF_USER]
    return unique([*(one for one in (*store.scene.typed_warnings, *at_start) if one.code not in kinds), *found])


def reached_maxima(store):
    """Largest pressure (Pa) and film temperature (deg C) of a thermal run."""
    return tuple(float(np.max(store.scalar(name))) for name in ("p_max_Pa", "film_max_C"))


def beyond_measured(store, summary):
    """Warnings about film pressures and temperatures beyond the measured range of conductivity and heat capacity."""
    if store.scene.isothermal or not beyond(conduction.LAWS, *reached_maxima(store)):
        return []
    p, T = reached_maxima(store)
    text = (f"the film reaches {p / 1e9:.2f} GPa and {T:.0f} deg C; {' and '.join(conduction.LAWS)} were measured up to "
            f"{conduction.P_MEASURED / 1e9:g} GPa and {conduction.GAMMA_MEASURED:g} deg C; beyond that range they keep their "
            "last values")
    return [with_data(text, p_max_Pa=p, film_max_C=T)]


def held_temperatures(store, summary):
    """Warning about temperatures that the solver limited to the allowed range."""
    held = 0 if store.scene.isothermal else int(np.nansum(store.scalar("clamped")))
    text = (f"temperatures were limited at {number_of(held, 'node')}, to the allowed range or (in columns without a solution) "
            "to the inlet temperature of the oil")
    return [with_data(text, nodes=held)] if held else []


def crowded(store, summary):
    """Warning about linear solves that fell back to one worker because other programs used the cores of the run."""
    done, fewer = summary.get("crowding", (0, 0))
    if fewer <= CROWDED * done:
        return []
    text = (f"another program used the cores of this run: {fewer} of {done} linear-solve launches ran with one worker. The "
            f"results are equal but slower; {FEWER}")
    return [with_data(text, FEWER, launches=int(done), with_one_worker=int(fewer))]


def of_single_peaks(store, summary):
    """One sentence on rough surfaces: extremes belong to single peaks; names of those without an error bar."""
    names = [name for names in _unknown(summary).values() for name in names]
    grid = finer_grid_option(store.scene)
    if names:
        text = (f"the largest and smallest values of rough surfaces belong to single peaks, and may not settle on any grid (no "
                f"error bar: {', '.join(map(_spoken, names))}); judge by percentiles and shares, or try {grid}")
        yield with_data(text, grid, numbers=names)


def unknown_errors(store, summary):
    """Warnings about numbers with unknown error, with the reason; one sentence for all with the same reason."""
    for why, names in _unknown(summary).items():
        grid = film_warnings.finer_grid(store.scene, why)
        window = _window(store) if grid and any(map(_passes, names)) else ""
        finer = "a grid that is finer along x" if why.code == "exit" else "a finer grid"
        more = (f"; try {finer}: {grid}" if grid else "") + (f", or {window}" if window else "")
        yield with_data(f"the error of {few_names(names)} is not known: {why}{more}", grid, window, numbers=names,
                        reason=str(why), reason_code=why.code)


def _passes(name):
    """Whether a number is of the passage, which a window follows."""
    return not name.startswith("steady ") and "smooth contact" not in name


def _window(store):
    """Option of a fine window, "" if the run cannot have one."""
    from tehl_taichi.runs import zoom_need

    return zoom_option(store.scene, functools.partial(zoom_need.work, store))


def few_names(names):
    """Text of names, abbreviated if there are many; the warning's data and the error table have all of them."""
    spoken = [_spoken(name) for name in names]
    return ", ".join(spoken) if len(names) <= MANY else f"{', '.join(spoken[:FIRST])} and {len(names) - FIRST} more numbers"


def _spoken(name):
    """Text of a name such as "steady h_c_m": "steady h_c"."""
    return re.sub(r"\w+_\w+", lambda key: short_name(key[0]), name.replace("surface_Fi_max", "Fi_max at the surface"))


def _unknown(summary):
    """{reason: names of the numbers whose error is unknown for it}."""
    searches = by_surface(summary)
    reasons: dict[Reason, list[str]] = {}
    parts = [(summary.get("steady", {}), "steady ", ""), (summary.get("transient", {}), "passage ", ""),
             (summary.get("contact_alone", {}), "", " of the smooth contact")]
    for body, fatigue in searches.items():
        parts += _of_search(searched(fatigue), f" of body {body}" * (len(searches) > 1))
    for part, when, behind in parts:
        for name, why in reasons_of(part).items():
            reasons.setdefault(why, []).append(f"{when}{name}{behind}")
    return reasons


def _of_search(fatigue, body):
    """[(part, "", text after its numbers)] of a fatigue search; body: its name as text."""
    early, deep, of_it = fatigue.get("resolved", {}), " below the surface", " of the resolved part"
    return [(fatigue.get("contact_alone", {}), "", f" of the smooth contact{body}"), (fatigue, "", body),
            (fatigue.get("below", {}), "", deep + body), (early, "", of_it + body),
            (early.get("below", {}), "", deep + of_it + body)]


def zoom_ended(store, summary):
    """Warning about a window that did not reach the end of its path."""
    zoom = summary.get("zoom", {})
    if zoom.get("ended"):
        to = "nowhere" if zoom["to_a"] is None else f"up to {zoom['to_a']:.2f} a"
        text = f"the zoom window ended early: {zoom['ended']}; numbers are the window's {to}, then those of the run alone"
        yield with_data(text, factor=zoom["factor"])


def largest_pressure(summary):
    """Largest pressure (Pa) of the steady start and the passage."""
    return max(summary.get(part, {}).get("p_max_Pa", 0.0) for part in ("steady", "transient"))


def yielding(store, summary):
    """Warning that a body would yield although both are elastic here: by its stresses, or by the pressure if no stress was
    searched.
    """
    elastic = "both bodies are elastic here, while real ones would yield and flatten in the first passages"
    p, found = largest_pressure(summary), summary.get("von_mises")
    if "run_in" in summary:
        elastic = "this body has no yield stress, so it is elastic here, while a real one would yield and flatten"
    if found and found["surface"] in steel_bodies(summary):  # `running_in` speaks of these
        return
    if found and passes_yield_stress(found):
        limit, doubt = passed_limit(found, store.scene)
        text = (f"the von Mises stress reaches {found['max_Pa'] / 1e9:.2f} GPa {place_text(found)}, more than "
                f"{limit}; {doubt or elastic}")
        yield with_data(text, von_mises_Pa=found["max_Pa"], yield_stress_Pa=found["yield_stress_Pa"])
    elif not found and "run_in" not in summary and p > (limit := yield_stress.pressure(store.scene)):
        text = f"p_max {p / 1e9:.2f} GPa: under asperities bodies like these yield above about {limit / 1e9:.1f} GPa; {elastic}"
        yield with_data(text, p_max_Pa=p, yields_Pa=limit)


def passes_yield_stress(part):
    """Whether a part "von_mises" exceeds the yield stress of its body, or of hardened steel if that is not known."""
    return part["max_Pa"] > part["yield_stress_Pa"] if part["yields"] is None else part["yields"]


def passed_limit(part, scene):
    """(text of the stress that a part "von_mises" exceeds, reason why its body is not known to yield there or "")."""
    body = getattr(scene, f"body_{part['surface']}")
    doubt = "" if part["yields"] else yield_stress.doubt(body, part["surface"])
    return yield_stress.words(part["yield_stress_Pa"], body), doubt


def steel_bodies(summary):
    """Names of the bodies whose steel yielded during run-in."""
    return summary.get("run_in", {}).get("by_surface", {})


def running_in(store, summary):
    """Warnings about a run-in."""
    if not (found := summary.get("run_in")):
        return
    new, before = found["new_plastic_strain"], found["plastic_strain_max"]
    if new > STILL * before:
        text = (f"steel still yields in the passage that is judged (plastic strain {new:.1e} more, {before:.1e} before): its "
                f"index is not that of a cycle; use a larger time.run_in (it is {store.scene.time.run_in})")
        yield with_data(text, new_plastic_strain=new)
    if (rest := found["unsettled_m"]) > 0:
        text = f"rounds of the first passage of run-in did not settle: its surface is known to {rest * 1e9:.0f} nm only"
        yield with_data(text, unsettled_m=rest)
    if not found["contained"]:
        yield with_data("plastic flow of the run-in reaches the rim of the region around the features, or a depth of 1 a; "
                        "surface and residual stress are wrong there")
    if "zoom" in summary and before > 0:
        yield _beyond_run_in(store.scene, summary["zoom"], found)


def _beyond_run_in(scene, zoom, found):
    """Warning about a window: steel flowed on the grid of the run; found: numbers of the run-in."""
    p, now, change = zoom["base"]["p_max_Pa"], zoom["p_max_Pa"], found["surface_change_max_m"] * 1e9
    error = error_of(found, "surface_change_max_m")
    size = with_error(change, None if error is None else error * 1e9, "nm")
    text = ("the error bars of the zoom window do not contain that of the run-in, whose steel flowed on the grid of the run "
            f"(surface change {size}{', error unknown' * (error is None)})")
    if now > max((1 + ABOVE) * p, yield_stress.pressure(scene)):
        text += (f"; it flowed under up to {p / 1e9:.2f} GPa, while the window has {now / 1e9:.2f} GPa: on a finer grid more "
                 "would flow")
    return with_data(text, p_max_Pa=p, zoom_p_max_Pa=now, surface_change_m=found["surface_change_max_m"])


def place_text(found, um="um"):
    """Text of the place of a von Mises stress."""
    at = f"surface {found['surface']}"
    return f"{micrometres(found['depth_m'])} {um} below {at}" if found["depth_m"] else f"at {at}"


def worst_below(store, summary):
    """Warning that the point that decides is below its surface, with the numbers of the verdict."""
    searches = by_surface(summary)
    if not searches or not (deep := judged_point(searches)).depth:
        return []
    parts, early = deciding(searches)
    top, *_ = judged_points({deep.surface: parts[deep.surface]})
    whole = searched(searches[deep.surface])
    alone_of = "from the pressure alone " * bool(why_none(summary["fatigue"]))
    body = (f" of body {deep.surface}" if others(summary) else "") + ", while the grid resolves the pressure" * early
    text = (f"{alone_of}the critical point lies below the surface{body}: Fi = {quantity(deep.part, deep.key)} at "
            f"{_um(deep.depth)}{over(deep.length, 'um')}, {quantity(top.part, top.key)} at the surface{over(top.length, 'um')}")
    alone = whole.get("contact_alone")
    if alone and alone["Fi_max"] > top.Fi:
        text += f"; the smooth contact has {quantity(alone, 'Fi_max')} at {_um(alone['depth_m'])}"
    grid = finer_grid_option(store.scene) if near_the_surface(deep.part, whole) else ""
    if grid:
        text += f"; this grid resolves nothing closer to the surface (half a cell); use a finer grid: {grid}"
    return [with_data(text, grid, Fi_max=top.Fi, below_Fi_max=deep.Fi, depth_m=deep.depth, length_m=deep.length)]


def _um(length):
    return f"{micrometres(length)} um"


# functions of (store, summary) that give their sentences, with the code of these
CHECKS = {domain_warnings.short: "domain", domain_warnings.cut_off: "outlet", domain_warnings.near_sides: "sides",
          domain_warnings.starved: "starved",
          worst_below: "below", rim_warnings.rims: "rim", yielding: "yield", running_in: "run-in", **film_warnings.CHECKS,
          beyond_measured: "measured", held_temperatures: "held", unknown_errors: "unknown", crowded: "crowded",
          zoom_ended: "zoom"}
ROUGH_CHECKS = {check: code for check, code in CHECKS.items() if code not in ("below", "peak", "resolved", "unknown")}
ROUGH_CHECKS |= {of_single_peaks: "rough"}
