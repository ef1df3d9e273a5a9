"""Crack paths from the loads of a passage: dedendum, pitch line, addendum; asperity and dent; widths; residual stress, friction
of the faces, oil inside. Errors from two grids of the film and from two discretisations of the crack."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from tehl_taichi.profiles import measure

from tehl_taichi.crack.analysis import follow
from tehl_taichi.crack.crack_options import SIDES, CrackOptions
from tehl_taichi.crack.symmetry_plane import plane_of
from tehl_taichi.errors import NotConverged
from tehl_taichi.runs.single_run import run_or_resume
from tehl_taichi.runs.sweep import pool
from tehl_taichi.scene import scene

GRIDS, QUICK_GRIDS = ((128, 32), (256, 64)), ((32, 8), (64, 16))
SLIPS = {"dedendum": -0.12, "pitch line": 0.0, "addendum": 0.12}
REFERENCE = "asperity 1.5 um, 200 um wide"
FEATURES = {REFERENCE: {}, "dent 1.5 um, 200 um wide": {"height": -1.5e-6}, "asperity, 100 um wide": {"width": 100e-6},
            "asperity, 400 um wide": {"width": 400e-6}}
# what else acts on the reference's cracks
CONDITIONS = {"": {}, "residual -200 MPa": {"residual": -200e6}, "residual +200 MPa": {"residual": 200e6},
              "face friction 0.3": {"face_friction": 0.3}, "oil 0.3 (upper bound)": {"oil": 0.3},
              "oil sealed in": {"oil": "sealed"}, "oil that flows": {"oil": "flow"}}
QUICK_CONDITIONS = {"": {}, "oil 0.3 (upper bound)": {"oil": 0.3}}
NUMBERS = {"sigma1": ("largest tension, MPa", 1e6, "{:.0f}"), "depth": ("tension down to, um", 1e-6, "{:.1f}"),
           "chord": ("trajectory at 20 um, deg", 1, "{:.0f}"), "K_first": ("K_I at 5 um", 1e6, "{:.2f}"),
           "K_later": ("K_I at 20 um", 1e6, "{:.2f}"), "K_II": ("range of K_II at 20 um", 1e6, "{:.1f}"),
           "path": ("path at 20 um, deg", 1, "{:.0f}")}


@dataclass(frozen=True)
class CrackRow:
    """One side of one case: {number: (value, what the coarser grid, what half the elements change or nan)} of NUMBERS; lean of
    the trajectory; why the crack stopped."""

    case: str
    side: str
    numbers: dict
    lean: str
    why: str


def cases(quick=False):
    """{name: scene}."""
    features = {REFERENCE: {}} if quick else FEATURES
    base = scene("gear").replace(**{"thermal.on": True})  # pure rolling has its heat of compression
    return {f"{kind}, {where}": base.replace(srr=srr, **changes)
            for kind, changes in features.items() for where, srr in SLIPS.items()}


def run(folder, quick=False, progress=None, workers=1, threads=None):
    """Generator of all rows so far, after every case; stores lie in `folder` and are used again. progress: called with a line
    of text; workers: processes side by side, each on `threads` threads (None: all that are left)."""
    notify = progress if workers == 1 else None  # other processes do not print
    grids, conditions = (QUICK_GRIDS, QUICK_CONDITIONS) if quick else (GRIDS, CONDITIONS)
    jobs = [(name, description, Path(folder).absolute(), grids, conditions if name.startswith(REFERENCE) else {"": {}}, notify)
            for name, description in cases(quick).items()]
    found = {}
    for number, rows in measure.side_by_side(case, jobs, workers, threads):
        name = jobs[number][0]
        found[name] = [CrackRow(name, "", {}, "", rows.reason)] if isinstance(rows, pool.LostJob) else rows
        if progress:
            progress(f"{name}: done")
        yield [row for job in jobs for row in found.get(job[0], [])]


def case(name, description, folder, grids, conditions, progress=None):
    """The rows of one case from runs on `grids`, under each of the conditions."""
    stores = _stores(name, description, folder, grids, progress or (lambda line: None))
    return rows_of(name, stores, conditions) if stores else []


def _stores(name, description, folder, grids, progress):
    """Stores of the runs that converge, the finest last."""
    found = []
    for nx, ny in grids:
        progress(f"{name}: {nx} x {ny} cells")
        try:
            path = folder / f"{name.replace(',', '').replace(' ', '-')}-{nx}.zarr"
            found.append(run_or_resume(description.replace(**{"grid.nx": nx, "grid.ny": ny, **measure.BARE}), path).store)
        except NotConverged as error:
            progress(f"{name}, {nx} x {ny} cells: {error}")
            found = []
    return found


def rows_of(name, stores, conditions):
    """The rows of a case from its stores, the finest last: two sides under every condition."""
    planes, rows = [plane_of(one.scene, one) for one in stores], []
    for condition, options in conditions.items():
        chosen = CrackOptions(**options)
        half = replace(chosen, elements=chosen.elements // 2)
        found = [_sides(plane, store, options) for plane, store, options in
                 ((planes[-1], stores[-1], half), *((plane, store, chosen) for plane, store in zip(planes, stores)))]
        rows += [_row(", ".join(filter(None, (name, condition))), side, *(one[side] for one in found)) for side in SIDES]
    return rows


def _sides(plane, store, options):
    return follow(plane.having(options.residual), store.scene, options).summary["sides"]


def _row(name, side, half, *grids):
    finest = grids[-1]
    if not finest["opens"]:
        return CrackRow(name, side, {}, "", finest["why"])
    numbers = _numbers(finest)
    coarser = [_numbers(grids[0]) if len(grids) > 1 and grids[0]["opens"] else {}, _numbers(half)]
    return CrackRow(name, side, {key: (value, *(abs(value - other.get(key, np.nan)) for other in coarser))
                            for key, value in numbers.items()}, finest["trajectory"]["lean"], finest["why"])


def _numbers(side):
    K = side["K"]
    at = min(K, key=lambda step: abs(step["length_m"] - 20e-6))
    return {"sigma1": side["sigma1_surface_Pa"], "depth": side["tension_depth_m"], "K_first": K[0]["K_I_max"],
            "K_later": at["K_I_max"], "K_II": at["K_II_range"], "chord": _degrees(side["trajectory"]),
            "path": _degrees(side["path"])}


def _degrees(shape):
    found = shape["chord_deg_at_um"]["20"]
    return np.nan if found is None else found


def cells(row):
    """Text of a row: numbers with their errors, how the trajectory leans, why the crack stopped."""
    if not row.numbers:
        return [row.side, *[""] * len(NUMBERS), "", row.why]
    return [row.side, *(_text(*row.numbers[key], *form[1:]) for key, form in NUMBERS.items()), row.lean, row.why]


def _text(value, grid, elements, unit, form):
    """Value ± change by the grid, by the elements; what a crack's elements do not touch has no second one."""
    if np.isnan(value):
        return "-"
    changes = [form.format(one / unit) if np.isfinite(one) else "?" for one in (grid, elements)]
    return f"{form.format(value / unit)} ± " + ", ".join(changes[: 1 + (elements != 0)])


COLUMNS = ("case", "side", *(title for title, *_ in NUMBERS.values()), "trajectory leans", "stop reason")


def page(rows):
    """Markdown of the table."""
    return "\n".join([*measure.markdown(COLUMNS, [(row.case, *cells(row)) for row in rows]), ""])


def chart(plt, rows):
    """Stress intensities of the cracks that open, with what the coarser grid changes."""
    shown = [row for row in rows if row.numbers]
    figure, ax, at = measure.chart_of_rows(plt, [f"{row.case}, {row.side}" for row in shown])
    for shift, key in ((-0.2, "K_first"), (0.0, "K_later"), (0.2, "K_II")):
        values, changes, _ = (np.array([row.numbers[key][n] for row in shown], float) / 1e6 for n in range(3))
        ax.errorbar(values, at + shift, xerr=changes, fmt="o", ms=4, label=NUMBERS[key][0])
    ax.set_xlabel("MPa m^0.5")
    ax.legend()
    return figure
