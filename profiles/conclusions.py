"""The conclusions of the thesis (Everitt 2018): Findley stresses of both bodies with errors, and a verdict on each.

Every case runs on three grids, each twice as fine (time steps shrink with the cells); errors as a run with coarse-grid runs has
them.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from tehl_taichi.profiles import measure, passage_stresses
from tehl_taichi.profiles.passage_stresses import ALONE, DEEP, DEPTHS, LOADS, WINDOWS

from tehl_taichi.errors import NotConverged, SceneError
from tehl_taichi.march.accuracy.error_bars import estimated_error
from tehl_taichi.runs.sweep import pool
from tehl_taichi.scene import scene
from tehl_taichi.values.coded_text import code_of

# cells along x more than across: that is what an exit needs (docs/exit.md); those that decide have four times as many
GRIDS, FINE_GRIDS, QUICK_GRIDS = ((128, 16), (256, 32), (512, 64)), ((512, 16), (1024, 32), (2048, 64)), ((32, 8), (64, 16))
EVERY = 1024  # columns of which each moment is stored; every second of twice as many changes Findley stresses by 0.03 %
DECIDE = "asperity 1.5 um", "dent 1.5 um"
SLIPS = (-0.12, 0.0, 0.12)
NEAR_ONE = 0.9
PARTS = "to 0.5 a", "whole"  # of the passage, about which there are statements
SIDES = ("all", "to 0.5 a"), ("all", "whole"), ("no thermal stress", "whole"), ("pressure", "whole")  # of those about the slip
# what a table says of an error that is not known, by the code of the reason
UNKNOWN = {"exit": "exit not resolved", "peak": "peak not resolved", "rival": "a rival grows"}


@dataclass(frozen=True)
class ConclusionRow:
    """One body of one case: Findley stress in Pa by (loads, window) and its error, DEEP and ALONE (Pa) and their depths (m)
    among them; friction over load on the footprint at x_a = -0.5 and 0.5 a; doubts: why errors are not known; reason: why it
    has no values; body: "a" carries the feature; grid: the finest one."""

    name: str
    srr: float
    values: dict
    errors: dict
    friction: tuple
    doubts: dict = field(default_factory=dict)
    reason: str = ""
    body: str = "a"
    grid: str = ""


def cases(quick=False):
    """{name: scene}; all with temperatures, so that pure rolling has its heat of compression."""
    base = scene("gear").replace(**{"thermal.on": True})
    kinds = dict(zip(DECIDE, ({}, {"height": -1.5e-6})))
    if not quick:
        kinds |= {"asperity, 1.5 GPa": {"hertz_pressure": 1.5e9}, "asperity, 2.5 GPa": {"hertz_pressure": 2.5e9},
                  "asperity 0.75 um": {"height": 0.75e-6}, "asperity 100 um wide": {"width": 100e-6},
                  "asperity, oil at 120 C": {"temperature": 120.0}}
    return {f"{kind}, SRR {srr:+g}": base.replace(srr=srr, **changes) for kind, changes in kinds.items() for srr in SLIPS}


def run(folder, quick=False, progress=None, workers=1, threads=None, columns=0):
    """Rows of all cases, two each; their stores lie in `folder` and are used again. progress: called with a line of text;
    workers: processes side by side, each on `threads` threads (None: all that are left); columns: of the finest grid of all
    cases (0: see :func:`grids_of`)."""
    folder = Path(folder).absolute()
    notify = progress if workers == 1 else None  # other processes do not print
    jobs = [(name, description, folder, grids_of(name, quick, columns), notify) for name, description in cases(quick).items()]
    found = {}
    for number, answer in measure.side_by_side(rows, jobs, workers, threads):
        name, description = jobs[number][:2]
        lost = isinstance(answer, pool.LostJob)
        found[name] = [_without(name, description, answer.reason)] if lost else answer
        if progress:
            progress(f"{name}: {found[name][0].reason or 'done'}")
    return [one for name in cases(quick) for one in found[name]]


def grids_of(name, quick=False, columns=0):
    """Grids of a case, from coarse to fine."""
    usual = QUICK_GRIDS if quick else FINE_GRIDS if name.startswith(DECIDE) and not columns else GRIDS
    found = tuple(grid for grid in usual if grid[0] <= columns) if columns else usual
    if not found:
        raise SceneError(f"columns = {columns} leaves no grid; allowed: at least {usual[0][0]}")
    return found


def rows(name, description, folder, grids, progress=None):
    """ConclusionRows of both bodies from runs on `grids`; a grid that does not converge is too coarse, no step of the error."""
    passages, reason = [], ""
    for nx, ny in grids:
        if progress:
            progress(f"{name}: {nx} x {ny} cells")
        try:
            store = folder / f"{file_name(name)}-{nx}x{ny}.zarr"
            passages.append(passage_stresses.read_passage(_sized(description, nx, ny), store))
        except NotConverged as error:
            passages, reason = [], f"{nx} x {ny} cells: {error}"
    if not passages:
        return [_without(name, description, reason)]
    return [_of_body(name, description, body, passages, f"{nx}x{ny}") for body in passages[-1].values]


def _without(name, description, reason):
    return ConclusionRow(name, description.operation.srr, {}, {}, (np.nan, np.nan), reason=reason)


def _of_body(name, description, body, passages, grid):
    values = passages[-1].values[body]
    known = {key: error_of(key, passages, body) for key in values}
    errors, doubts = ({key: pair[n] for key, pair in known.items()} for n in (0, 1))
    return ConclusionRow(name, description.operation.srr, values, errors, passages[-1].friction, doubts, body=body, grid=grid)


def _sized(description, nx, ny):
    return description.replace(**{"grid.nx": nx, "grid.ny": ny, "output.every": max(1, nx // EVERY), **measure.BARE})


def error_of(key, passages, body="a"):
    """(error of a value of the last grid or nan, why it is not known); passages: PassageStresses on each grid, from coarse to
    fine."""
    follows = key[0] in LOADS or key in DEEP.values()  # a number that depends on the highest pressures of its window
    courses = [one.courses[key[1]] for one in passages] if follows else ()
    return estimated_error([one.values[body][key] for one in passages], passages[-1].doubts.get(key, ""), courses)


def verdicts(rows, limit, windows=PARTS, loads=SIDES):
    """[(statement, verdict, figures)] from the rows; limit: sigma_eF, Pa; windows, loads: of the keys in their values. First of
    body a, which the thesis judges, then of the worse body and of the mating one."""
    of_a = {r.name: r for r in rows if not r.reason and r.body == "a"}
    of_b = {r.name: r for r in rows if not r.reason and r.body == "b"}
    kinds = [kind for kind in dict.fromkeys(r.name.rsplit(", SRR", 1)[0] for r in rows) if kind.startswith("asperity")]
    out = [*_thesis(_reader(of_a), kinds, limit, "", windows, loads), *_deeper(of_a, "", windows)]
    if (r := of_a.get("asperity 1.5 um, SRR -0.12")) and np.isfinite(r.friction).all():
        out.append(("friction on the asperity is larger near the inlet than near the outlet",
                    "follows" if r.friction[0] > r.friction[1] else "does not follow",
                    f"{r.friction[0]:.4f} at -0.5 a, {r.friction[1]:.4f} at 0.5 a"))
    if not of_b:
        return out
    both = _thesis(lambda *case: larger(_reader(of_a)(*case), _reader(of_b)(*case)), kinds, limit, "worse body: ",
                   windows, loads)
    return out + [*both, *_deeper(of_b, "body b: ", windows), *_mating(of_a, of_b, windows[0])]


def _reader(by_name):
    """Function (kind, SRR, key) that gives (value, error)."""
    def get(kind, srr, key=("all", "whole")):
        r = by_name.get(f"{kind}, SRR {srr:+g}")
        return (r.values[key], r.errors[key]) if r and key in r.values else (np.nan, np.nan)

    return get


def larger(one, other):
    """(value, error) of the larger of two; unknown where either is."""
    (f, e), (g, d) = sorted((one, other), reverse=True)
    return f, e if f - e > g + d else max(e, d) if np.isfinite(e + d) else np.nan


def _thesis(get, kinds, limit, whose, windows, loads):
    """Statements about the level without slip, dents, and the sign of the slip."""
    for window in windows:
        f, e = get("asperity 1.5 um", 0.0, ("all", window))
        yield (f"{whose}an asperity brings Fi near or over 1 (>= {NEAR_ONE:g}) at about 2 GPa without slip; {window}",
               decide(f - NEAR_ONE * limit, e), _pair((f, e), (NEAR_ONE * limit, 0.0)))
        for srr in SLIPS:
            pair = [get(kind, srr, ("all", window)) for kind in ("asperity 1.5 um", "dent 1.5 um")]
            yield f"{whose}a dent gives less than an asperity of the same size (SRR {srr:+g}); {window}", *_compared(*pair)
    for load, window in loads:
        for kind in kinds:
            if kind == "asperity 1.5 um" or load == "all":
                pair = [get(kind, srr, (load, window)) for srr in (-0.12, 0.12)]
                yield f"{whose}Fi(SRR -0.12) > Fi(SRR +0.12): {kind}; {load}; {window}", *_compared(*pair)


def _deeper(by_name, whose, windows):
    """Whether the critical point of the reference asperity lies below the surface."""
    for name, r in by_name.items():
        if name.startswith("asperity 1.5 um"):
            for window in windows:
                pair = [(r.values[each], r.errors[each]) for each in (DEEP[window], ("all", window))]
                yield f"{whose}the critical point lies below the surface: {name}; {window}", *_compared(*pair)


def _mating(of_a, of_b, window):
    """Whether body b has the larger stress, at the surface or below it."""
    for name in of_b:
        pair = [larger(*((r.values[key], r.errors[key]) for key in (("all", window), DEEP[window])))
                for r in (of_b[name], of_a[name])]
        yield f"body b has a larger stress than body a (surface or below): {name}; {window}", *_compared(*pair)


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


def file_name(name):
    """Name of a case in files."""
    signed = name.replace("SRR -", "SRR minus ").replace("SRR +", "SRR plus ")
    return "-".join("".join(c if c.isalnum() else " " for c in signed).split())


def cells(row, columns=tuple(("all", window) for window in WINDOWS)):
    """Text of a row's values with errors, MPa; the reason first where there are none; "" for a column that it lacks."""
    if row.reason:
        return [row.reason] + [""] * (len(columns) - 1)
    return [_with_error(row.values[key], row.errors[key], row.doubts.get(key, "")) + _at_depth(row, key)
            if key in row.values else "" for key in columns]


def _at_depth(row, key):
    return f" at {row.values[DEPTHS[key]] * 1e6:.0f} um" if key in DEPTHS else ""


def _title(loads, window):
    both = f"{loads}, {window}" if (loads, window) in DEEP.values() else loads
    return window if loads == "all" else both


COLUMNS = [*(("all", window) for window in WINDOWS), ("no thermal stress", "whole"), ("pressure", "whole"), *DEEP.values(),
           ALONE]


def page(rows, judged, scene_, columns=COLUMNS):
    """Markdown of the table and the verdicts."""
    lines = measure.markdown(("case", "body", "grid", *(_title(*column) for column in columns)),
                             [(r.name, r.body, r.grid, *cells(r, columns)) for r in rows])
    lines += ["", *measure.markdown(("statement", "verdict", "figures"), [(what, f"**{verdict}**", figures)
                                                                         for what, verdict, figures in judged])]
    f = scene_.fatigue
    return "\n".join([f"Findley stress in MPa (kappa_F = {f.kappa:g}); Fi = f / {f.endurance / 1e6:g} MPa.", "", *lines, ""])


def plain_row(row):
    """A row as its JSON has it; depths have no error."""
    found = {"; ".join(key): (value, row.errors.get(key, np.nan)) for key, value in row.values.items()}
    return {"case": row.name, "body": row.body, "grid": row.grid, "reason": row.reason, "friction": row.friction,
            "findley_stress_Pa": found}


def chart(plt, rows):
    """Findley stress of each case over the whole passage, at the surface and below it, with errors."""
    shown = [row for row in rows if not row.reason]
    figure, ax, at = measure.chart_of_rows(plt, [f"{row.name}, {row.body}" for row in shown])
    for shift, key, label in ((-0.15, ("all", "whole"), "surface"), (0.15, DEEP["whole"], "below it")):
        errors = [row.errors[key] / 1e6 for row in shown]
        ax.errorbar([row.values[key] / 1e6 for row in shown], at + shift, xerr=errors, fmt="o", ms=4, label=label)
    ax.set_xlabel("Findley stress, MPa (no bar: error not known)")
    ax.legend()
    return figure
