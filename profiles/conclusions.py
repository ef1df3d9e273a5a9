"""The conclusions of the thesis (Everitt 2018) as a table of Findley stresses with errors, and a verdict on each.

Every case runs on three grids, each twice as fine (time steps shrink with the cells); errors as a run with companions has them.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from tehl_taichi.profiles import measure, passage_stresses
from tehl_taichi.profiles.passage_stresses import ALONE, DEEP, DEPTHS, LOADS, WINDOWS

from tehl_taichi.errors import NotConverged
from tehl_taichi.march.accuracy.error_bars import estimated_error
from tehl_taichi.runs.sweep import pool
from tehl_taichi.scene import scene
from tehl_taichi.values.coded_text import code_of

# cells along x more than across: that is what an exit asks for (docs/exit.md); those that decide have four times as many
GRIDS, FINE_GRIDS, QUICK_GRIDS = ((128, 16), (256, 32), (512, 64)), ((512, 16), (1024, 32), (2048, 64)), ((32, 8), (64, 16))
EVERY = 1024  # columns of which each moment is stored; every second of twice as many changes Findley stresses by 0.03 %
DECIDE = "asperity 1.5 um", "dent 1.5 um"
SLIPS = (-0.12, 0.0, 0.12)
NEAR_ONE = 0.9
# what a table says of an error that is not known, by the code of the reason
UNKNOWN = {"exit": "exit not resolved", "peak": "peak not resolved", "rival": "a rival grows"}
BARE = {"fatigue.on": False, "numerics.estimate_error": False}  # both are worked out here, for all grids and loads together


@dataclass(frozen=True)
class ConclusionRow:
    """One case: Findley stress in Pa by (loads, window) and its error, DEEP and ALONE (Pa) and their depths (m) among them;
    friction over load on the footprint at x_a = -0.5 and 0.5 a; doubts: why errors are not known; reason: why it has no
    values."""

    name: str
    srr: float
    values: dict
    errors: dict
    friction: tuple
    doubts: dict = field(default_factory=dict)
    reason: str = ""


def cases(quick=False):
    """{name: scene}; all with temperatures, so that pure rolling has its heat of compression."""
    base = scene("gear").replace(**{"thermal.on": True})
    kinds = dict(zip(DECIDE, ({}, {"height": -1.5e-6})))
    if not quick:
        kinds |= {"asperity, 1.5 GPa": {"hertz_pressure": 1.5e9}, "asperity, 2.5 GPa": {"hertz_pressure": 2.5e9},
                  "asperity 0.75 um": {"height": 0.75e-6}, "asperity 100 um wide": {"width": 100e-6},
                  "asperity, oil at 120 C": {"temperature": 120.0}}
    return {f"{kind}, SRR {srr:+g}": base.replace(srr=srr, **changes) for kind, changes in kinds.items() for srr in SLIPS}


def run(folder, quick=False, progress=None, workers=1, threads=None):
    """Rows of all cases; their stores lie in `folder` and are used again. progress: called with a line of text; workers:
    processes side by side, each on `threads` threads (None: all that are left)."""
    folder = Path(folder).absolute()
    notify = progress if workers == 1 else None  # other processes have nobody to tell
    jobs = [(name, description, folder, grids_of(name, quick), notify) for name, description in cases(quick).items()]
    found = {}
    for number, answer in measure.side_by_side(row, jobs, workers, threads):
        name, description = jobs[number][:2]
        lost = isinstance(answer, pool.LostJob)
        found[name] = ConclusionRow(name, description.operation.srr, {}, {}, (np.nan, np.nan),
                                    reason=answer.reason) if lost else answer
        if progress:
            progress(f"{name}: {found[name].reason or 'done'}")
    return [found[name] for name in cases(quick)]


def grids_of(name, quick=False):
    """Grids of a case, from coarse to fine."""
    return QUICK_GRIDS if quick else FINE_GRIDS if name.startswith(DECIDE) else GRIDS


def row(name, description, folder, grids, progress=None):
    """One ConclusionRow from runs on `grids`; one that does not converge is too coarse, and no step of the error."""
    told, reason = [], ""
    for nx, ny in grids:
        if progress:
            progress(f"{name}: {nx} x {ny} cells")
        try:
            told.append(passage_stresses.read_passage(_sized(description, nx, ny), folder / f"{_slug(name)}-{nx}x{ny}.zarr"))
        except NotConverged as error:
            told, reason = [], f"{nx} x {ny} cells: {error}"
    if not told:
        return ConclusionRow(name, description.operation.srr, {}, {}, (np.nan, np.nan), reason=reason)
    last = told[-1]
    known = {key: error_of(key, told) for key in last.values}
    errors, doubts = ({key: pair[n] for key, pair in known.items()} for n in (0, 1))
    return ConclusionRow(name, description.operation.srr, last.values, errors, last.friction, doubts)


def _sized(description, nx, ny):
    return description.replace(**{"grid.nx": nx, "grid.ny": ny, "output.every": max(1, nx // EVERY), **BARE})


def error_of(key, told):
    """(error of a value of the last grid or nan, why it is not known); told: by each grid, from coarse to fine."""
    follows = key[0] in LOADS or key in DEEP.values()  # a number that depends on the highest pressures of its window
    courses = [one.courses[key[1]] for one in told] if follows else ()
    return estimated_error([one.values[key] for one in told], told[-1].doubts.get(key, ""), courses)


def verdicts(rows, limit):
    """[(statement, verdict, figures)] from the rows; limit: sigma_eF, Pa."""
    by_name = {r.name: r for r in rows if not r.reason}
    out = []

    def get(kind, srr, key=("all", "whole")):
        r = by_name.get(f"{kind}, SRR {srr:+g}")
        return (r.values[key], r.errors[key]) if r else (np.nan, np.nan)

    for window in ("to 0.5 a", "whole"):
        f, e = get("asperity 1.5 um", 0.0, ("all", window))
        out.append((f"an asperity brings Fi near or over 1 (>= {NEAR_ONE:g}) at about 2 GPa without slip; {window}",
                    decide(f - NEAR_ONE * limit, e), _pair((f, e), (NEAR_ONE * limit, 0.0))))
        for srr in SLIPS:
            one, other = (get(kind, srr, ("all", window)) for kind in ("asperity 1.5 um", "dent 1.5 um"))
            out.append((f"a dent gives less than an asperity of the same size (SRR {srr:+g}); {window}",
                        *_compared(one, other)))
    for loads, window in (("all", "to 0.5 a"), ("all", "whole"), ("no thermal stress", "whole"), ("pressure", "whole")):
        for kind in dict.fromkeys(r.name.rsplit(", SRR", 1)[0] for r in rows):
            if kind.startswith("asperity") and (kind == "asperity 1.5 um" or loads == "all"):
                one, other = (get(kind, srr, (loads, window)) for srr in (-0.12, 0.12))
                out.append((f"Fi(SRR -0.12) > Fi(SRR +0.12): {kind}; {loads}; {window}", *_compared(one, other)))
    for name in by_name:
        if name.startswith("asperity 1.5 um"):
            f, e = by_name[name].values, by_name[name].errors
            for window, key in DEEP.items():
                one, other = ((f[each], e[each]) for each in (key, ("all", window)))
                out.append((f"the critical point lies below the surface: {name}; {window}", *_compared(one, other)))
    r = by_name.get("asperity 1.5 um, SRR -0.12")
    if r:
        out.append(("friction on the asperity is larger near the inlet than near the outlet",
                    "follows" if r.friction[0] > r.friction[1] else "does not follow",
                    f"{r.friction[0]:.4f} at -0.5 a, {r.friction[1]:.4f} at 0.5 a"))
    return out


def decide(difference, error):
    """Whether a difference expected to be positive is so beyond its error."""
    if not np.isfinite(difference + error) or abs(difference) <= error:
        return "not decided"
    return "follows" if difference > 0 else "does not follow"


def _compared(one, other):
    return decide(one[0] - other[0], one[1] + other[1]), _pair(one, other)


def _pair(one, other):
    return " against ".join(_with_error(f, e) for f, e in (one, other)) + " MPa"


def _with_error(f, error, doubt=""):
    if np.isfinite(error):
        return f"{f / 1e6:.0f} ± {error / 1e6:.0f}"
    return f"{f / 1e6:.0f} ({UNKNOWN.get(code_of(doubt), 'error unknown')})"


def _slug(name):
    signed = name.replace("SRR -", "SRR minus ").replace("SRR +", "SRR plus ")
    return "-".join("".join(c if c.isalnum() else " " for c in signed).split())


def cells(row, columns=tuple(("all", window) for window in WINDOWS)):
    """Text of a row's values with errors, MPa; the reason first where there are none."""
    if row.reason:
        return [row.reason] + [""] * (len(columns) - 1)
    return [_with_error(row.values[key], row.errors[key], row.doubts.get(key, "")) + _at_depth(row, key) for key in columns]


def _at_depth(row, key):
    return f" at {row.values[DEPTHS[key]] * 1e6:.0f} um" if key in DEPTHS else ""


def _title(loads, window):
    both = f"{loads}, {window}" if (loads, window) in DEEP.values() else loads
    return window if loads == "all" else both


def page(rows, judged, scene_):
    """Markdown of the table and the verdicts."""
    columns = [("all", window) for window in WINDOWS] + [("no thermal stress", "whole"), ("pressure", "whole")]
    columns += [*DEEP.values(), ALONE]
    lines = ["| case | " + " | ".join(_title(*column) for column in columns) + " |",
             "|---" * (len(columns) + 1) + "|"]
    for r in rows:
        lines.append(f"| {r.name} | " + " | ".join(cells(r, columns)) + " |")
    lines += ["", "| statement | verdict | figures |", "|---|---|---|"]
    lines += [f"| {statement} | **{verdict}** | {figures} |" for statement, verdict, figures in judged]
    f = scene_.fatigue
    return "\n".join([f"Findley stress in MPa (kappa_F = {f.kappa:g}); Fi = f / {f.endurance / 1e6:g} MPa.", "", *lines, ""])


def plain_row(row):
    """A row as its JSON has it."""
    return {"case": row.name, "reason": row.reason, "friction": row.friction, "findley_stress_Pa": {
        "; ".join(key): (value, row.errors[key]) for key, value in row.values.items()}}


def chart(plt, rows):
    """Findley stress of each case over the whole passage, at the surface and below it, with errors."""
    shown = [row for row in rows if not row.reason]
    figure, ax = plt.subplots(figsize=(8, 0.35 * len(shown) + 1.4), constrained_layout=True)
    at = np.arange(len(shown))
    for shift, key, label in ((-0.15, ("all", "whole"), "surface"), (0.15, DEEP["whole"], "below it")):
        errors = [row.errors[key] / 1e6 for row in shown]
        ax.errorbar([row.values[key] / 1e6 for row in shown], at + shift, xerr=errors, fmt="o", ms=4, label=label)
    ax.set(xlabel="Findley stress, MPa (no bar: error not known)", yticks=at, yticklabels=[row.name for row in shown])
    ax.invert_yaxis()
    ax.legend()
    return figure
