"""tehl bench: the suites under profiles/."""

from pathlib import Path
from typing import Optional

import typer
from tehl_cli.bench_accuracy import accuracy
from tehl_cli.bench_options import FORCE, JSON, OUT, QUICK, THREADS, WORKERS, WRITE, Heat, folder
from tehl_cli.bench_stability import stability
from tehl_cli.live_display import say
from tehl_cli.single_options import Command
from tehl_cli.suite_results import Results, texts

from tehl_taichi.engine.cores import available


def conclusions(
    out: Path = folder("runs/conclusions", "folder of the stores and results (existing stores are reused)"),
    quick: bool = typer.Option(False, "--quick", help="run the reference asperity and dent on coarse grids"),
    columns: int = typer.Option(0, help="columns of the finest grid (128, 256, 512 for all cases; default: 512, the asperities "
                                        "and dents of 1.5 um 2048)", min=0),
    zoom: int = typer.Option(0, help="judge the whole passage by runs on 256 x 64 cells with a window of this factor, 2, 4 or "
                                     "8, and stresses averaged over fatigue.length"),
    as_json: bool = JSON, force: bool = FORCE, threads: Optional[int] = THREADS, workers: int = WORKERS,
):
    """Check the conclusions of the thesis: Findley stress of both bodies by slip, feature, pressure and part of the passage.

    Example: `tehl bench conclusions --quick`
    """
    from tehl_taichi.profiles import conclusions as suite
    from tehl_taichi.profiles import zoomed_conclusions

    from tehl_taichi.scene import scene

    results, base = Results(out, "conclusions", force, as_json, more=("md",)), scene("gear")
    judge = zoomed_conclusions if zoom else suite
    if zoom:
        rows, shown = judge.run(out, zoom, quick, say, threads), {("all", "whole"): "surface", suite.DEEP["whole"]: "below"}
    else:
        rows, shown = suite.run(out, quick, say, workers, threads, columns), {("all", one): one for one in suite.WINDOWS}
    judged = judge.verdicts(rows, base.fatigue.endurance)
    results.table("Findley stress, MPa", ("case", "body", *shown.values()),
                  [(r.name, r.body, *suite.cells(r, tuple(shown))) for r in rows])
    results.table("the thesis' conclusions", ("statement", "verdict", "figures"), judged)
    results.page(judge.page(rows, judged, base))
    results.finish([suite.plain_row(r) for r in rows], lambda plt: suite.chart(plt, rows),
                   verdicts=[dict(zip(("statement", "verdict", "figures"), one)) for one in judged])


def verdict(
    out: Path = folder("runs/verdict", "folder of the stores and results (existing stores are reused)"),
    quick: bool = typer.Option(False, "--quick", help="run the default asperity on 64 x 16 cells"),
    only: Optional[list[str]] = typer.Option(None, help="SCENE or SCENE:VARIANT to run, instead of all (repeatable), as "
                                                        "dent or dent:all; with --write the other rows stay"),
    as_json: bool = JSON, force: bool = FORCE,
    write: bool = typer.Option(False, "--write", help="replace the table in docs/strength.md (of the current folder)"),
    threads: Optional[int] = THREADS, workers: int = WORKERS,
):
    """Compare the fatigue index without and with a case-hardened profile, residual stress and run-in.

    Example: `tehl bench verdict`
    """
    from tehl_taichi.profiles import verdict as suite

    from tehl_taichi.values.checks import choice

    for name in only or ():
        choice("--only", name, suite.choices())
    results = Results(out, "verdict", force, as_json, more=("md",), write=write)
    for rows in suite.run(out, quick, say, workers, threads, only):  # those so far are kept, whatever comes
        results.keep([suite.plain_row(row) for row in rows], note=suite.NOTE)
        results.page(suite.page(rows))
        if only:
            results.documented(suite.COLUMNS, suite.texts(rows), keys=2)
    results.table("fatigue index by strength", suite.COLUMNS, suite.texts(rows))
    say(suite.NOTE)
    if not only:
        results.documented(suite.COLUMNS, suite.texts(rows))
    results.finish([suite.plain_row(row) for row in rows], lambda plt: suite.chart(plt, rows), note=suite.NOTE)


def cracks(
    out: Path = folder("runs/cracks", "folder of the stores and results (existing stores are reused)"),
    quick: bool = typer.Option(False, "--quick", help="run the reference asperity on coarse grids"),
    as_json: bool = JSON, force: bool = FORCE, threads: Optional[int] = THREADS, workers: int = WORKERS,
):
    """Compute crack paths from the loads of a passage, with errors. Example: `tehl bench cracks --quick`"""
    from tehl_taichi.profiles import cracks as suite

    results = Results(out, "cracks", force, as_json, more=("md",))
    for rows in suite.run(out, quick, say, workers, threads):  # those so far are kept, whatever comes
        results.keep([vars(row) for row in rows])
        results.page(suite.page(rows))
    results.table("crack paths", suite.COLUMNS, [(row.case, *suite.cells(row)) for row in rows])
    results.finish([vars(row) for row in rows], lambda plt: suite.chart(plt, rows))


def zoom(
    out: Path = folder("runs/zoom", "folder of the stores and results (existing stores are reused)"),
    quick: bool = typer.Option(False, "--quick", help="run one line contact on coarse grids"),
    as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE, threads: Optional[int] = THREADS,
):
    """Compare runs with a fine window to runs that are as fine everywhere. Example: `tehl bench zoom --quick`"""
    from tehl_taichi.profiles import zoom as suite

    results = Results(out, "zoom", force, as_json, write=write)
    for rows in suite.run(out, quick, threads, say):  # those so far are kept, whatever comes
        results.keep([vars(row) for row in rows])
    lines = suite.lines(rows)
    results.table("fine grid everywhere: fine window (off by %)", suite.COLUMNS, lines)
    results.documented(suite.COLUMNS, lines)
    results.finish([{**vars(row), "off": row.off, "holds": row.holds} for row in rows], lambda plt: suite.chart(plt, rows))


def speed(out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE,
          threads: Optional[int] = THREADS):
    """Measure run times against their targets, and reference loops to compare machines. Example: `tehl bench speed --quick`"""
    from tehl_taichi.profiles import speed as suite

    results = Results(out, "speed", force, as_json, write=write)
    rows = suite.run(quick, threads or available(), say)
    details = {"step_ms": "step {:.1f} ms", "convolutions": "{:.0f} convolutions", "cycles": "{:.1f} Krylov",
               "memory_mb": "{:.0f} MB", "planes_per_s_core": "{:.2g} planes/s core"}
    shown = [{**row, "detail": ", ".join(form.format(row[key]) for key, form in details.items() if key in row)} for row in rows]
    columns = {"what": "{}", "seconds": "{:.3f}", "target": "{:g}", "detail": "{}"}
    results.show("speed", rows, columns, lambda plt: suite.chart(plt, rows), shown)


def scaling(out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE,
            threads: Optional[int] = THREADS, thermal: Heat = False):
    """Measure time and memory against grid size and threads. Example: `tehl bench scaling --quick`"""
    from tehl_taichi.profiles import scaling as suite

    results = Results(out, "scaling", force, as_json, write=write)
    rows = suite.run(quick, threads or available(), thermal, say)
    columns = {"nx": "{}", "ny": "{}", "threads": "{}", "step_ms": "{:.1f}", "speed_up": "{:.2f}", "node_ns": "{:.0f}",
               "newton": "{:.1f}", "cycles": "{:.1f}", "memory_mb": "{:.0f}", "node_B": "{:.0f}"}
    results.show("scaling", rows, columns, lambda plt: suite.chart(plt, rows))


def sweep(out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE,
          workers: Optional[int] = typer.Option(None, min=1, help="largest number of workers (default: one per core)")):
    """Measure the speed-up of a sweep of 16 cases on 1, 2, 4 ... workers. Example: `tehl bench sweep --workers 2`"""
    from tehl_taichi.profiles import side_by_side as suite

    results = Results(out, "sweep", force, as_json)
    rows = suite.run(quick, workers, say)
    columns = {"workers": "{}", "seconds": "{:.1f}", "cases_s": "{:.1f}", "speed_up": "{:.2f}"}
    results.show("cases in parallel", rows, columns, lambda plt: suite.chart(plt, rows))


def profile(out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE,
            threads: Optional[int] = THREADS, thermal: Heat = True):
    """Measure the time of a step per stage and per kernel. Example: `tehl bench profile --isothermal`"""
    from tehl_taichi.profiles import measure
    from tehl_taichi.profiles import profile as suite

    results = Results(out, "profile", force, as_json, write=write)
    stages, kernels, numbers = measure.fresh(threads or available(), suite.run, *(suite.QUICK if quick else suite.FULL),
                                             thermal)
    columns = {"what": "{}", "calls": "{:.1f}", "ms": "{:.2f}", "limit_ms": "{:.2f}", "MB": "{:.1f}"}
    results.documented(columns, texts(stages, columns))
    results.table("stages, per step (a stage may contain others)", columns, texts(stages, columns))
    results.table("kernels, per step", columns, texts(kernels, columns))
    say(", ".join(f"{key} {value:.3f}" for key, value in numbers.items()))
    say("largest possible gains, ms per step: " + ", ".join(f"{what} {ms:.1f}" for what, ms in suite.gaps(stages, kernels)))
    rows = [{"kind": kind, **row} for kind, part in (("stage", stages), ("kernel", kernels)) for row in part]
    results.finish(rows, lambda plt: suite.chart(plt, stages, kernels, numbers["step_s"]), **numbers)


bench = typer.Typer(no_args_is_help=True, help="Run a benchmark suite. Each suite prints a table; its numbers do not change "
                                               "the exit code, but a scene of `stability` that fails does (1).")
for _suite in (stability, conclusions, verdict, cracks, accuracy, speed, zoom, scaling, sweep, profile):
    bench.command(cls=Command)(_suite)
