"""The conclusions of the thesis (Everitt 2018) as a table of Findley stresses with errors, and a verdict on each.

Every case runs on three grids, each twice as fine (time steps shrink with the cells); errors as a run with companions has them.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from tehl_taichi.profiles import measure

from tehl_taichi.errors import NotConverged
from tehl_taichi.fatigue import below, findley
from tehl_taichi.fatigue.histories import Passage
from tehl_taichi.fatigue.under_row import at_the_surface
from tehl_taichi.march import companions, readings
from tehl_taichi.march.error_bars import RIVAL, estimated_error
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.study import pool
from tehl_taichi.study.single import completed

# cells along x more than across: that is what an exit asks for (docs/exit.md); those that decide have twice as many
GRIDS, FINE_GRIDS, QUICK_GRIDS = ((128, 16), (256, 32), (512, 64)), ((256, 16), (512, 32), (1024, 64)), ((64, 16), (128, 32))
DECIDE = "asperity 1.5 um", "dent 1.5 um"
SLIPS = (-0.12, 0.0, 0.12)
WINDOWS = {"entry": (-np.inf, -0.5), "inside": (-0.5, 0.5), "exit": (0.5, np.inf), "to 0.5 a": (-np.inf, 0.5),
           "whole": (-np.inf, np.inf)}
# what counts: pressure alone, with the shear tractions, with thermal stress too
LOADS = {"pressure": {"fatigue.shear": False, "fatigue.thermal_stress": False},
         "no thermal stress": {"fatigue.thermal_stress": False}, "all": {}}
NEAR_ONE = 0.9
# the worst below the surface under the feature's row, up to 0.5 a and over the whole passage, and of the contact without it
DEEP, ALONE = {window: ("below", window) for window in ("to 0.5 a", "whole")}, ("contact alone", "whole")
# what a table says of an error that is not known, by the beginning of the reason
UNKNOWN = {reason.partition("{")[0]: short for reason, short in (
    (readings.EXIT, "exit not resolved"), (readings.SPIKE, "peak not resolved"), (RIVAL, "a rival grows"))}
BARE = {"fatigue.on": False, "numerics.estimate_error": False}  # both are worked out here, for all grids and loads together
DEPTHS = {**{key: ("depth", window) for window, key in DEEP.items()}, ALONE: ("depth alone", "whole")}


@dataclass(frozen=True)
class Row:
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
    tell = progress if workers == 1 else None  # other processes have nobody to tell
    jobs = [(name, description, folder, grids_of(name, quick), tell) for name, description in cases(quick).items()]
    found = {}
    for number, answer in measure.side_by_side(row, jobs, workers, threads):
        name, description = jobs[number][:2]
        lost = isinstance(answer, pool.Lost)
        found[name] = Row(name, description.operation.srr, {}, {}, (np.nan, np.nan), reason=answer.reason) if lost else answer
        if progress:
            progress(f"{name}: {found[name].reason or 'done'}")
    return [found[name] for name in cases(quick)]


def grids_of(name, quick=False):
    """Grids of a case, from coarse to fine."""
    return QUICK_GRIDS if quick else FINE_GRIDS if name.startswith(DECIDE) else GRIDS


def row(name, description, folder, grids, progress=None):
    """One Row from runs on `grids`; one that does not converge is too coarse, and no step of the error."""
    found, courses, friction, reason = [], [], (np.nan, np.nan), ""
    for nx, ny in grids:
        if progress:
            progress(f"{name}: {nx} x {ny} cells")
        sized = description.replace(**{"grid.nx": nx, "grid.ny": ny, **BARE})
        try:
            saved = completed(sized, folder / f"{_slug(name)}-{nx}.zarr").store
        except NotConverged as error:
            found, courses, reason = [], [], f"{nx} x {ny} cells: {error}"
            continue
        found.append(stresses(saved))
        courses.append({window: course(saved, *ends) for window, ends in WINDOWS.items()})
        friction = tuple(footprint_friction(saved, at) for at in (-0.5, 0.5))
    if not found:
        return Row(name, description.operation.srr, {}, {}, friction, reason=reason)
    doubts = unresolved(saved)
    told = {key: error_of(key, found, courses, doubts.get(key, "")) for key in found[-1]}
    errors, doubts = ({key: pair[n] for key, pair in told.items()} for n in (0, 1))
    return Row(name, description.operation.srr, found[-1], errors, friction, doubts)


def error_of(key, found, courses, doubt):
    """(error of a value of the last grid or nan, why it is not known); found: values on each grid, courses: of the pressures in
    each window there."""
    follows = key[0] in LOADS or key in DEEP.values()  # a number that depends on the highest pressures of its window
    return estimated_error([one[key] for one in found], doubt, [one[key[1]] for one in courses] if follows else ())


def course(saved, low, high):
    """The :func:`tehl_taichi.march.companions.course` of a stored passage between two positions of its feature (a)."""
    at, p = saved.scalar("feature_x")[1:] / Scales.of(saved.scene).a, saved.scalar("p_max_Pa")[1:]
    inside = (at >= low) & (at <= high)
    return companions.course(p[inside], at[inside], saved.scene.path)


def unresolved(saved):
    """{(loads, window): why the grid does not know it}, of windows with a pressure peak that it does not resolve."""
    a = Scales.of(saved.scene).a
    at, p = saved.scalar("feature_x")[1:] / a, saved.scalar("p_max_Pa")[1:]
    entries = {window: 1 + np.flatnonzero((at >= low) & (at <= high)) for window, (low, high) in WINDOWS.items()}
    doubts = {window: readings.unresolved(saved, those, p[those - 1].max(), a) for window, those in entries.items()
              if those.size}
    keys = [(loads, window) for loads in LOADS for window in WINDOWS] + [*DEEP.values()]
    return {key: doubts[key[1]] for key in keys if doubts.get(key[1])}


def stresses(saved):
    """{(loads, window): largest Findley stress, Pa}; windows with every load, the other loads over the whole passage."""
    out = {}
    for loads, changes in LOADS.items():
        passage = Passage(saved.scene.replace(**changes) if changes else saved.scene, saved, saved.scalar("feature_x"))
        history = at_the_surface(passage)(slice(0, passage.y.size))
        for window, (low, high) in WINDOWS.items():
            if loads == "all" or window == "whole":
                inside = _moments(passage, low, high)
                out[loads, window] = float(findley.search(history[:, inside], saved.scene.fatigue.kappa)[0].max())
    return out | deep_stresses(Passage(saved.scene, saved, saved.scalar("feature_x")))


def _moments(passage, low, high):
    """Those of a history with the feature between `low` and `high` (in a), and the one without load."""
    return np.append((passage.centres >= low * passage.a) & (passage.centres <= high * passage.a), True)


def deep_stresses(passage):
    """DEEP, ALONE and their depths."""
    row = int(np.argmin(np.abs(passage.reader.y - passage.scene.features[0].y)))
    *deep, _, alone = below.profiles(passage, [row], True, [_moments(passage, *WINDOWS[window]) for window in DEEP])
    return {key: value for stress, profile in zip(DEPTHS, (*deep, alone))
            for key, value in ((stress, profile.worst.f), (DEPTHS[stress], profile.worst.depth))}


def footprint_friction(saved, at):
    """Friction over load on the feature's footprint when it is at x_a = at (in a)."""
    a = Scales.of(saved.scene).a
    n = int(np.argmin(np.abs(saved.scalar("feature_x") / a - at)))
    fields = saved.fields(n, ("pressure", "traction_x_a"))
    distance = np.hypot(saved.x[:, None] - saved.feature_x(n), saved.y[None, :])
    under = distance < saved.scene.features[0].reach
    return float(abs(fields["traction_x_a"][under].sum()) / fields["pressure"][under].sum())


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
                out.append((f"the worst point lies below the surface: {name}; {window}", *_compared(one, other)))
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
    return f"{f / 1e6:.0f} ({next((short for begins, short in UNKNOWN.items() if doubt.startswith(begins)), 'error unknown')})"


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
