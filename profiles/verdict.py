"""The verdict by what a body is made of: the index with a case-hardened profile, with residual stress, after run-in, with all.

Every scene runs once on each of three grids, without a search, and again for each variant with run-in. Each variant is searched
on all of them, so that its error bars are those of a run with coarse-grid runs.
"""

import json
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from tehl_taichi.profiles import measure

from tehl_taichi import __version__
from tehl_taichi.disk import files
from tehl_taichi.errors import Error
from tehl_taichi.fatigue import assessment
from tehl_taichi.fatigue.judged_layers import leading
from tehl_taichi.fatigue.pressure_alone import searched
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.march.accuracy.domain_error import DomainError
from tehl_taichi.runs.single_run import run_or_resume
from tehl_taichi.runs.sweep import pool
from tehl_taichi.scene import Scene, scene
from tehl_taichi.store.json_values import plain
from tehl_taichi.values.digits import micrometres, with_error

SCENES = ("gear", "dent", "touching-asperity", "rough-pair")
NAMES = {"gear": "1.5 µm asperity (default)", "dent": "1.5 µm dent", "touching-asperity": "3 µm asperity",
         "rough-pair": "ground flanks, 99th percentile"}
CASE = {"fatigue.table": "case-hardened"}
RESIDUAL = {"fatigue.residual_xx": -4e8, "fatigue.residual_yy": -4e8}
RUN_IN = {"time.run_in": 3, "bodies.a.yield_stress": 2.2e9, "bodies.b.yield_stress": 2.2e9}
VARIANTS = {"default": {}, "case": CASE, "residual": RESIDUAL, "run-in": RUN_IN, "all": {**CASE, **RESIDUAL, **RUN_IN}}
MEANS = {"default": "as it is", "case": "case profile", "residual": "residual stress −400 MPa",
         "run-in": "run-in, 2.2 GPa", "all": "all three"}
NOTE = "run-in: three passages at most, both bodies of steel that flows at 2.2 GPa and does not harden"
ALONE = {"fatigue.on": True, "numerics.estimate_error": True}
QUICK = {"grid.nx": 64, "grid.ny": 16}
FINER = {"dent": {"grid.nx": 512, "grid.ny": 32}}  # its exit is not resolved on 256 columns


@dataclass(frozen=True)
class VerdictRow:
    """The worse body of a scene with a variant: index at its surface and below it (of rough surfaces the 99th percentile), the
    depth (m) of the latter, errors (None: not known, see `unknown`), limits (Pa) at both; until_a: position (a) of the feature
    up to which its grid resolves the pressure, where the numbers are those up to there; reason: why there are no numbers."""

    scene: str
    variant: str
    Fi_surface: float | None = None
    Fi_below: float | None = None
    depth_m: float | None = None
    error: dict | None = None
    surface: str = ""
    limits_Pa: tuple = ()
    unknown: str = ""
    until_a: float | None = None
    reason: str = ""


def run(folder, quick=False, progress=None, workers=1, threads=None, only=()):
    """Generator of the rows so far, in the order of scenes and variants: after each row, with several workers after each scene.

    Stores and rows lie in `folder` and are used again. progress: called with a line of text; workers, threads: as of
    :func:`tehl_taichi.profiles.measure.side_by_side`; only: scenes in place of all, SCENE or SCENE:VARIANT.
    """
    folder, found = Path(folder).absolute(), {}
    variants = _variants(only or SCENES[: 1 if quick else None])
    names = list(variants)
    alone = workers == 1
    says = progress if alone else None  # other processes do not print
    jobs = [(name, folder, quick, says, variants[name]) for name in names]
    for number, answer in measure.side_by_side(rows if alone else _listed, jobs, workers, threads):
        own = found[names[number]] = []
        for row in _lost(names[number], answer.reason) if isinstance(answer, pool.LostJob) else answer:
            own.append(row)
            if alone:
                yield _in_order(found, names)
        if not alone:
            yield _in_order(found, names)


def _variants(only):
    """{scene: its variants} of SCENE or SCENE:VARIANT each, in the order of both."""
    parts = {(name, own or None) for name, _, own in (one.partition(":") for one in only)}
    found = {name: [one for one in VARIANTS if {(name, one), (name, None)} & parts] for name in SCENES}
    return {name: variants for name, variants in found.items() if variants}


def choices():
    """What `only` of :func:`run` may name."""
    return tuple(name + part for name in SCENES for part in ("", *(f":{variant}" for variant in VARIANTS)))


def _in_order(found, names):
    return [row for name in names for row in found.get(name, [])]


def _lost(name, reason):
    return [VerdictRow(name, variant, reason=reason) for variant in VARIANTS]


def _listed(*job):
    """All rows of a scene, for another process."""
    return list(rows(*job))


def rows(name, folder, quick=False, progress=None, variants=tuple(VARIANTS)):
    """Generator of the VerdictRows of a scene with these variants."""
    base, stores = scene(name).replace(**(QUICK if quick else FINER.get(name, {}))), {}
    for variant, changes in ((one, VARIANTS[one]) for one in variants):
        described, own = base.replace(**changes), variant if "time.run_in" in changes else ""
        file = folder / f"{name}-{variant}-{base.grid.nx}x{base.grid.ny}.json"
        if kept := _kept(file, described):
            yield kept
            continue
        try:
            stores[own] = stores.get(own) or _passages(described if own else base, folder, progress, f"-{own}" if own else "")
            if progress:
                progress(f"{name}: {MEANS[variant]}")
            row = _row(name, variant, described, *stores[own])
            _keep(file, described, row)
            yield row
        except Error as error:
            yield VerdictRow(name, variant, reason=str(error))


def _keep(file, description, row):
    """Write a row beside the stores that it was searched in."""
    with files.disk_errors(file):
        content = {"version": __version__, "scene": description.to_dict(), "row": plain(plain_row(row))}
        files.replace(file, json.dumps(content).encode())


def _kept(file, description):
    """The VerdictRow of a scene that an earlier suite of this version left; None where there is none."""
    try:
        found = files.json_of(file)
        if found["version"] != __version__ or Scene.from_dict(found["scene"]) != description:
            return None
        return VerdictRow(**{**found["row"], "limits_Pa": tuple(found["row"]["limits_Pa"])})
    except (OSError, ValueError, KeyError, TypeError, Error):
        return None


def _passages(base, folder, progress, variant=""):
    """(store of the passage, [(scene, store) of coarser grids that converge]), coarsest first; variant: behind the names of
    the stores."""
    coarser, own = [], None
    for one in [base, *reversed(coarse_runs.scenes(base)[0])]:
        if progress:
            progress(f"{base.name}{variant}: {one.grid.nx} x {one.grid.ny} cells")
        try:
            path = folder / f"{base.name}{variant}-{one.grid.nx}x{one.grid.ny}.zarr"
            found = run_or_resume(one.replace(**measure.BARE), path).store
        except Error:
            if own is None:
                raise
            break  # no coarser one is of use either
        if own is None:
            own = found
        else:
            coarser.insert(0, (one, found))
    return own, coarser


def _row(name, variant, description, store, coarser):
    """The VerdictRow of a variant of the scene whose passages are stored."""
    description = description.replace(**ALONE)
    until = coarse_runs.resolved(description, store, store.scalar)
    found = assessment.run(description, store, until=until, alone=False).summaries
    known, reasons = _errors(description, store, coarser, found, until)
    worst = max(found, key=lambda body: max(value for _, value, *_ in _parts(body, searched(found[body]), known)))
    own = searched(found[worst])
    (top, at_top, top_error), (deep, below, deep_error), *_ = _parts(worst, own, known)
    limits = own["sigma_eF_Pa"], own["below"].get("sigma_eF_Pa", own["sigma_eF_Pa"])
    unknown = next((str(why) for key, why in reasons.items() if key.startswith(f"{worst}:{coarse_runs.FI}")), "")
    early = [part["to_x_a"] for part in (top, deep) if part in _resolved(own)]
    return VerdictRow(name, variant, at_top, below, deep["depth_m"], {"Fi_surface": top_error, "Fi_below": deep_error}, worst,
                      limits, unknown if None in (top_error, deep_error) else "", min(early, default=None))


def _errors(description, store, coarser, found, until):
    """{name among the readings: error bar or None} of a search on the finest grid, and {name: why there is none}."""
    changes = {f"fatigue.{key}": getattr(description.fatigue, key) for key in ("table", "residual_xx", "residual_yy")}

    def answers():
        return [_answer(one.replace(**ALONE, **changes), saved, until) for one, saved in coarser]

    domain = DomainError.from_values(store.known("steady_domain"))
    errors = coarse_runs.errors(description, store, found, answers, domain)
    return errors["passage_error"], errors["passage_unknown"]


def _answer(description, saved, until):
    """Readings of a coarser grid, as :func:`tehl_taichi.march.accuracy.coarse_runs.answers` gives them."""
    try:
        found = assessment.run(description, saved, until=until, alone=False).summaries
        readings = coarse_runs.passage_readings(description, saved, saved.scalar, found)
    except Error as error:
        return {"reason": str(error)}
    return {"values": {key: asdict(reading) for key, reading in readings.items()}}


def _parts(body, found, known):
    """[(part of the summary, its index, error or None)] at the surface and below it, as the verdict of a run takes them."""
    if found.get("rough"):
        top, deep = found["statistics"], found["below"]["statistics"]
        return [(top, top["p99"], known.get(f"{body}:0 um.p99")),
                (deep, deep["p99"], known.get(f"{body}:{deep['depth_m'] * 1e6:.4g} um.p99"))]
    errors = {"": coarse_runs.FI, "below": coarse_runs.BELOW, "averaged": coarse_runs.AVERAGED,
              "averaged below": coarse_runs.AVERAGED_BELOW}
    wide = found.get("averaged", {})
    parts = {"": found, "below": found.get("below"), "averaged": wide, "averaged below": wide.get("below")}
    with_bars = {what: {**part, "error": {"Fi_max": known.get(coarse_runs.of_surface(body, errors[what]))}}
                 for what, part in parts.items() if part}
    nested = _nested(with_bars)
    whole = [(part, part["Fi_max"], part["error"]["Fi_max"]) for part, _ in leading(nested)]
    return [_better(one, early, known.get(coarse_runs.of_surface(body, key))) for one, early, key in
            zip(whole, _resolved(found) or [None, None], (coarse_runs.RESOLVED, coarse_runs.RESOLVED_BELOW))]


def _resolved(found):
    """Parts of a search at the surface and below it up to where the grid resolves the pressure; [] of one that it resolves."""
    part = found.get("resolved")
    return [part, {"to_x_a": part["to_x_a"], **part["below"]}] if part else []


def _better(whole, early, error):
    """A part with its index and error, of the resolved part of the passage where its error alone is known."""
    return (early, early["Fi_max"], error) if early and whole[2] is None and error is not None else whole


def _nested(parts):
    """A summary of these parts, as a run has it."""
    out = {**parts[""], "below": parts.get("below")}
    if "averaged" in parts:
        out["averaged"] = {**parts["averaged"], "below": parts.get("averaged below")}
    return out


COLUMNS = ("scene", "variant", "body", "Fi at the surface", "Fi below", "depth, µm", "limit, MPa")


def cells(row):
    """A row as texts behind the scene and the variant."""
    if row.reason:
        return "", row.reason, "", "", ""
    top, deep = (with_error(value, row.error[key], digits=3) for key, value in
                 (("Fi_surface", row.Fi_surface), ("Fi_below", row.Fi_below)))
    limit, inside = (f"{one / 1e6:.0f}" for one in row.limits_Pa)
    return row.surface, top, deep, micrometres(row.depth_m), limit if limit == inside else f"{limit}, {inside}"


def texts(rows):
    """All rows as texts."""
    return [(NAMES[row.scene], MEANS[row.variant], *cells(row)) for row in rows]


def page(rows):
    """Markdown of the table."""
    return "\n".join([*measure.markdown(COLUMNS, texts(rows)), "", *notes(rows), f"{NOTE[0].upper()}{NOTE[1:]}."])


def notes(rows):
    """Sentences on bars that are not known, and on rows of a part of the passage, once each."""
    open_ = [f"{NAMES[row.scene]}, {MEANS[row.variant]}: errors not known, {row.unknown}." for row in rows if row.unknown]
    part = [f"{NAMES[row.scene]}, {MEANS[row.variant]}: of the passage up to {row.until_a:.2f} a, later pressures are not "
            "resolved on this grid." for row in rows if row.until_a is not None]
    return list(dict.fromkeys([*open_, *part]))


def chart(plt, rows):
    """Index at the surface and below it, by variant, a panel for each scene."""
    names = [name for name in dict.fromkeys(row.scene for row in rows) if any(r.scene == name and not r.reason for r in rows)]
    figure, axes = plt.subplots(1, max(len(names), 1), figsize=(3 * max(len(names), 1), 3), squeeze=False, sharey=True)
    for ax, name in zip(axes[0], names):
        own = [row for row in rows if row.scene == name and not row.reason]
        for key, label in (("Fi_surface", "at the surface"), ("Fi_below", "below")):
            ax.errorbar(range(len(own)), [getattr(row, key) for row in own], [row.error[key] or 0.0 for row in own], fmt="o",
                        capsize=3, label=label)
        ax.axhline(1.0, color="grey", lw=0.8)
        ax.set(title=NAMES[name], xticks=range(len(own)), xticklabels=[row.variant for row in own])
    axes[0, 0].set_ylabel("Fi")
    axes[0, 0].legend()
    figure.tight_layout()
    return figure


def plain_row(row):
    """The row as JSON has it."""
    return asdict(replace(row, limits_Pa=list(row.limits_Pa)))
