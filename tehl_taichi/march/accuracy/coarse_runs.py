"""Coarse-grid runs: the passage of a run on grids with a half and a quarter of the cells, for error bars.

They take about a seventh of its time: after the run, with its tables and compiled kernels, or beside it in the background
(:mod:`tehl_taichi.runs.background_errors`). They cannot harm the run: if one is refused or does not converge, the bar is
unknown, with the reason.
"""

import itertools
from dataclasses import asdict, replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from tehl_taichi.engine import runtime
from tehl_taichi.errors import Error
from tehl_taichi.fatigue import index_statistics
from tehl_taichi.fatigue.pressure_alone import searched
from tehl_taichi.march import quantities
from tehl_taichi.march.accuracy import readings
from tehl_taichi.march.accuracy.domain_error import DomainError, widened
from tehl_taichi.march.accuracy.error_bars import GridReading, bars
from tehl_taichi.march.accuracy.peaks import LEAST
from tehl_taichi.scene import resolution
from tehl_taichi.scene.resolution import HALVED, MULTIPLES
from tehl_taichi.scene.rough_surfaces import is_rough
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.timeline import total_steps
from tehl_taichi.values.coded_text import Reason, code_of

COMPANIONS = HALVED  # with the run itself three grids; 1/8 and 1/64 of its cells and steps
FI, BELOW = "Fi_max", "below_Fi_max"  # names of the largest index of the surface, and below it
RESOLVED, RESOLVED_BELOW = "resolved_Fi_max", "resolved_below_Fi_max"  # of both as long as the grid resolves the pressure
AVERAGED, AVERAGED_BELOW = "averaged_Fi_max", "below_averaged_Fi_max"  # of both, of stresses over fatigue.length
MISES = "von_mises_max_Pa"  # of the von Mises stress
MIDDLE = "middle_h_min_m"  # of the smallest film with the feature in the middle of the contact
CONTACT, AREA = "contact_load_fraction_max", "contact_area_share_max"
PART = 0.1  # a
FEW = 4 / 3  # points; a bar has 1.5 times as many
FAR = 0.5  # index, its 99th percentile on a grid: below it no finer grid has points above 1
TOP, REST = 1.0, 0.5  # GridReading.spread of the 99th percentile at the surface, which short waves raise, and of all others
# of the run-in
RUN_IN = "surface_change_max_m", "height_after_m", "plastic_strain_max", "residual_min_Pa", "residual_max_Pa"
SHALLOW = Reason("it is largest at the smallest searched depth (half a cell), which no grid resolves", "shallow")
SHALLOWEST = 1.5  # of that depth: up to the next one that is searched
HEAVIER = 5.0  # with temperatures a step takes so many times as long
WORTH = 3e5  # nodes times steps of a run: below, it is a try, on a grid whose coarse-grid runs say little


def scenes(scene):
    """([scenes with half and a quarter of the cells, coarsest first], [reasons for omitted ones]); steps grow with the
    cells.
    """
    out, refused = [], []
    for level in range(1, COMPANIONS + 1):
        nx, ny = scene.grid.nx // 2**level, scene.grid.ny // 2**level
        steps = min(scene.time.steps, max(1, scene.time.steps // 2**level))  # -1 is all
        try:
            out.append(_resolved_scene(scene, 2**level).replace(**{"grid.nx": nx, "grid.ny": ny, "time.steps": steps,
                                                                   "output.profiles": False}))
        except Error as error:
            refused.append(f"a coarse-grid run on {nx} x {ny} cells is refused: {error}")
    return out[::-1], [*refused, *_cells_for_all(scene)] if refused else []


def _resolved_scene(scene, times):
    """Scene without the features that a grid with 1/times of the columns does not resolve; with all if it resolves none.

    Of roughness the long waves are kept; the effect of the others is part of the difference between grids.
    """
    seen = resolution.resolved_features(scene, times)
    return replace(scene, features=seen) if seen else scene


def _cells_for_all(scene):
    """Sentences about the cell numbers that allow every coarse-grid run, if those of the scene do not."""
    nx, ny = (least << COMPANIONS for least, _ in MULTIPLES.values())
    if scene.grid.nx % nx or scene.grid.ny % ny:
        yield f"use a grid.nx that is a multiple of {nx} and a grid.ny that is a multiple of {ny}"


def passage_readings(scene, reader, scalar, searches=None, run_in=None):
    """{name: GridReading} of the numbers of a passage.

    reader: entries for :class:`tehl_taichi.fatigue.stress.histories.StressHistories`, the steady start first; scalar(name):
    array of the entries' values; searches: {surface: summary of its search}, or None; run_in: numbers of its run-in, or None.
    """
    p, h, a = *(scalar(name)[1:] for name in ("p_max_Pa", "h_min_m")), Scales.of(scene).a
    bars_of = [entry for entry in quantities.of_part("transient") if entry.error]
    out = {entry.key: _reading(entry, scalar, scene) for entry in bars_of if entry.exists(scene)}
    out["p_max_Pa"] = readings.pressure_reading(_moment(reader, int(np.argmax(p)) + 1), a)
    out["h_min_m"] = readings.film_reading(_moment(reader, int(np.argmin(h)) + 1), scene)
    middle = np.argmin(np.abs([reader.feature_x(n) + scene.features[0].x for n in range(1, p.size + 1)]))
    out[MIDDLE] = readings.film_reading(_moment(reader, int(middle) + 1), scene)
    found = indices(searches or {})
    out |= {name: GridReading(float(part["Fi_max"]), doubt=_shallow(name, found)) for name, part in found.items()}
    out |= _of_cells(out, searches or {})
    mises = von_mises_parts(searches or {})
    out |= {name: GridReading(part["max_Pa"]) for name, part in mises.items()}
    out |= {f"{name}.{key}": _spread_reading(part, key)
            for name, part in distributions(searches or {}) for key in index_statistics.NUMBERS}
    steel = {of_run_in(key): GridReading(run_in[key]) for key in RUN_IN if key in (run_in or {})}
    out |= steel
    # a peak that the grid does not resolve at some moment: neither its pressure is known nor what it does to oil and steel
    why = readings.pressure_doubt(reader, _high(p), p.max(), a)
    pressures = course(p, [reader.feature_x(n) / a for n in range(1, p.size + 1)], scene.path)
    of = {kind: [entry.key for entry in bars_of if entry.error == kind] for kind in (quantities.SWAYED, quantities.SHARP)}
    out |= {name: replace(out[name], swayed=bool(why)) for name in of[quantities.SWAYED] if name in out}
    sharp = (*of[quantities.SHARP], *whole(found), *mises, *steel)
    return out | {name: _with_doubt(out[name], why, pressures) for name in sharp
                  if name in out}


def _reading(entry, scalar, scene):
    """Reading of a number that is no extreme over the nodes."""
    value = entry.of(scalar(entry.series), None)
    if entry.key in quantities.HEAT:
        return readings.temperature_reading(value, scene, passing=True)
    return GridReading(value, positive=entry.positive)


def _spread_reading(part, key):
    """Reading of a number of a distribution.

    A share has an uncertainty of two of its points; a share of zero has one only if the index is near 1.
    """
    uncertain = key == "share_above_1" and (part[key] > 0 or part["p99"] > FAR)
    blur = FEW / part["points"] if uncertain else 0.0
    return GridReading(float(part[key]), blur=blur, spread=TOP if key == "p99" and "depth_m" not in part else REST)


def _of_cells(out, searches):
    """Readings of the averaged index on a grid whose cells are as long as the averaging length: the values at its nodes."""
    names = [(of_surface(surface, wide), of_surface(surface, own)) for surface in searches
             for wide, own in ((AVERAGED, FI), (AVERAGED_BELOW, BELOW))]
    return {wide: out[own] for wide, own in names if wide not in out and own in out}


def _with_doubt(reading, why, pressures):
    """Reading with a doubt `why`, if it depends on the highest pressures (a :func:`course`)."""
    return replace(reading, doubt=why or reading.doubt, course=() if code_of(reading.doubt) == SHALLOW.code else pressures)


def course(p, at, path):
    """Largest of the pressures p in each PART of the path, at feature positions `at` (a); nan for a part without any."""
    parts = np.floor((np.asarray(at) - path[0]) / PART + 1e-9).astype(int)
    count = int(np.floor((path[1] - path[0]) / PART + 1e-9)) + 1
    return tuple(float(p[parts == n].max()) if (parts == n).any() else np.nan for n in range(count))


def _shallow(name, found):
    """Reason why an index below the surface is unknown, if it grows towards the surface up to the smallest depth of the search,
    and exceeds the index of the surface; otherwise "". found: see :func:`indices`.
    """
    (surface, part), above = name.split(":"), {BELOW: FI, RESOLVED_BELOW: RESOLVED, AVERAGED_BELOW: AVERAGED}
    if part not in above or not near_the_surface(found[name], found[of_surface(surface, FI)]):
        return ""
    return SHALLOW if found[name]["Fi_max"] > found[of_surface(surface, above[part])]["Fi_max"] else ""


def near_the_surface(deep, fatigue):
    """Whether the worst depth of a part below is at the smallest depth of the search; fatigue: the summary of that search."""
    return deep["depth_m"] < SHALLOWEST * fatigue["below"].get("searched_m", [0.0])[0]


def indices(searches):
    """{name of its largest index among the readings: part of the summary of a search}, for existing parts; searches: {surface:
    summary of its search}.
    """
    found: dict[str, Any] = {}
    for surface, summary in searches.items():
        whole = searched(summary)
        early, wide = whole.get("resolved", {}), whole.get("averaged", {})
        parts = {FI: whole, BELOW: whole.get("below"), RESOLVED: early, RESOLVED_BELOW: early.get("below"),
                 AVERAGED: wide, AVERAGED_BELOW: wide.get("below")}
        found |= {of_surface(surface, name): part for name, part in parts.items() if part}
    return found


def distributions(searches):
    """[(name among the readings, statistics of a search)] at the surface and at every depth; searches: see :func:`indices`."""
    out = []
    for surface, summary in searches.items():
        found = searched(summary)
        deep = found.get("below", {}).get("statistics", {})
        parts = [part for part in (found.get("statistics"), deep, *deep.get("by_depth", [])) if part]
        out += [(of_surface(surface, f"{part.get('depth_m', 0.0) * 1e6:.4g} um"), part) for part in parts]
    return out


def von_mises_parts(searches):
    """{name among the readings: numbers of the von Mises stress} of searches; see :func:`indices`."""
    found = {surface: searched(summary).get("von_mises") for surface, summary in searches.items()}
    return {of_surface(surface, MISES): part for surface, part in found.items() if part}


def of_surface(surface, name):
    """Name, among the readings, of an index of a surface."""
    return f"{surface}:{name}"


def of_run_in(key):
    """Name, among the readings, of a number of the run-in."""
    return f"run_in:{key}"


def whole(found):
    """Names in `found` (see :func:`indices`) that cover all moments and stresses at points."""
    return [name for name in found if name.split(":")[1] in (FI, BELOW)]


def resolved(scene, reader, scalar):
    """Position (a) of the feature up to which the grid resolves every pressure peak; None if it always does."""
    p, a = scalar("p_max_Pa")[1:], Scales.of(scene).a
    first = next((n for n in _high(p) if readings.pressure_doubt(reader, [n], p.max(), a)), None)
    return None if first is None else float(reader.feature_x(first - 1)) / a


def _high(p):
    """Entries whose pressure is high enough for a peak that makes the largest one unknown; p: pressures from entry 1 on."""
    return [int(n) + 1 for n in np.flatnonzero(p >= LEAST * p.max())]


def values(scene, notify=lambda: None, until=lambda: None):
    """{name: GridReading} of one coarse-grid run. Raises NotConverged.

    notify(): called after each step; until(): see :func:`answers`.
    """
    from tehl_taichi.fatigue import assessment
    from tehl_taichi.fatigue.sought import Sought
    from tehl_taichi.march.passage import march

    reader, run_in = _passages(scene, notify) if scene.runs_in else (assessment.Snapshots(_steps(march(scene), notify)), None)
    with_fatigue = scene.has_fatigue and len(reader) > 2
    found = None
    if with_fatigue:
        found = assessment.run(scene, reader, until=until(), alone=False, sought=Sought.COUNTED).summaries
    return passage_readings(scene, reader, lambda name: np.array([shot.scalars[name] for shot in reader.items]), found, run_in)


def _steps(shots, notify):
    """List of the snapshots of a march; notify(): called after each."""
    out = []
    for shot in shots:
        out.append(shot)
        notify()
    return out


def _passages(scene, notify):
    """(Snapshots of the passage after the run-in of a scene, numbers of the run-in); notify(): called after each step."""
    from tehl_taichi.fatigue.assessment import Snapshots
    from tehl_taichi.march.passage import march
    from tehl_taichi.plastic import run_in, run_in_numbers

    first, = _steps(itertools.islice(march(scene), 1), notify)
    start = first.state

    def passage(changes):
        return Snapshots([first, *_steps(march(scene, start, changes), notify)])

    reader, state = run_in.repeat_passages(scene, passage)
    return Snapshots(reader.items, state.residual_fields), run_in_numbers.numbers(scene, state)


def _moment(reader, n):
    return SimpleNamespace(x=reader.x, feature_x=reader.feature_x(n), fields=reader.fields(n, ("pressure", "film")))


def errors(scene, reader, searches, coarse, domain=DomainError(), run_in=None):
    """Error bars of the numbers of a run: {"passage_error": {name: error bar or None}, "passage_unknown": {name: reason of
    None}, "passage_parts": {name: {"grid", "domain"}}}.

    {} without a passage; without coarse-grid runs the reasons only. reader: its store; searches: {surface: summary of its
    search} or None; coarse(): results of :func:`answers`; domain: DomainError of the steady start; run_in: numbers of its
    run-in, or None.
    """
    if len(reader) < 2:
        return {}
    own = passage_readings(scene, reader, reader.scalar, searches, run_in)
    if not has_coarse_runs(scene):
        touches = own[CONTACT].value > 0
        doubts = {name: reading.doubt for name, reading in own.items() if reading.doubt}
        doubts |= dict.fromkeys((CONTACT, AREA), readings.TOUCH) if touches else {}
        return {"passage_error": {} if touches else dict.fromkeys((CONTACT, AREA), 0.0), "passage_unknown": doubts}
    values = {name: reading.value for name, reading in own.items()}
    bars_of, reasons = judged(coarse(), own)
    found, unknown, parts = widened(bars_of, reasons, values, domain, scene.operation.temperature, passing=True)
    return {"passage_error": found, "passage_unknown": unknown, "passage_parts": parts}


def has_coarse_runs(scene):
    """Whether a run has coarse-grid runs: if they are requested, or, unless refused, if the run is long enough or the surfaces
    are rough (where one grid says little).
    """
    choice = scene.numerics.estimate_error
    return choice is True or choice is not False and (work(scene) >= WORTH or scene.has_fatigue and is_rough(scene))


def work(scene):
    """Work of a run: nodes times steps."""
    return nodes(scene) * total_steps(scene)


def heavy_work(scene):
    """Work of a run in that of steps without temperatures."""
    return work(scene) * (1.0 if scene.isothermal else HEAVIER)


def nodes(scene):
    """Number of nodes of a grid."""
    return (scene.grid.nx + 1) * (scene.rows + 1)


def answers(scene, notify=lambda done, total: None, until=lambda: None):
    """Results of the coarse-grid runs of a scene, coarsest first, for :func:`judged`.

    The finest one runs first: if it fails, coarser ones are useless. until(): result of :func:`resolved` for the run itself,
    called when needed.
    """
    (coarser, reasons), done = scenes(scene), itertools.count()
    out: list[dict[str, Any]] = []
    total = sum(total_steps(one) + 1 for one in coarser)  # with their starts
    for one in reversed(coarser):
        with runtime.grown(nodes(scene) / nodes(one)):  # by the kernels of the run: to trace theirs takes 0.2 s of 18
            out.insert(0, answer(one, lambda: notify(min(next(done), total), total), until))  # run-in makes more steps
        if "reason" in out[0]:
            break
    notify(total, total)
    return [{"reason": reason} for reason in reasons] + out


def judged(coarse, own):
    """({name: error bar or None}, {name: reason of None}) of own {name: GridReading}.

    coarse: results of the coarse-grid runs, coarsest first, {"values": {name: values of a GridReading}} or {"reason": of a
    failure}.
    """
    grids: list[dict[str, GridReading]] = []
    reasons: list[str] = []
    for one in coarse:
        if "reason" in one:  # too coarse a grid: neither it nor the coarser ones are of use
            grids, reasons = [], [*reasons, one["reason"]]
        else:
            grids.append({name: GridReading(**values) for name, values in one["values"].items()})
    found, unknown = bars([*grids, own], passing=True)
    none = Reason("; ".join(reasons) or "no coarser grid is possible", "coarse")
    return found, unknown if grids else dict.fromkeys(unknown, none)


def answer(scene, notify=lambda: None, until=lambda: None):
    """Result of one coarse-grid run, for :func:`judged`; notify(): called after each step; until(): see :func:`answers`."""
    try:
        return {"values": {name: asdict(reading) for name, reading in values(scene, notify, until).items()}}
    except Error as error:
        return {"reason": f"a coarse-grid run on {scene.grid.nx} x {scene.grid.ny} cells failed: {error}"}
