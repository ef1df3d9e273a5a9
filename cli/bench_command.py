"""tehl bench: the suites under profiles/."""

import itertools
import json
import os
from pathlib import Path
from typing import Optional

import typer
from tehl_cli.idle_options import say_idle
from tehl_cli.live_display import say
from tehl_cli.stdout import print_json
from tehl_cli.suite_results import Results, table, texts


def register(app):
    """Add the group of commands to the app."""
    bench = typer.Typer(no_args_is_help=True, help="Run a benchmark suite. Each suite prints a table; none fails on its "
                                                   "numbers.")
    bench.command()(stability)
    bench.command()(conclusions)
    bench.command()(verdict)
    bench.command()(cracks)
    bench.command()(accuracy)
    bench.command()(speed)
    bench.command()(zoom)
    bench.command()(scaling)
    bench.command()(sweep)
    bench.command()(profile)
    app.add_typer(bench, name="bench")


def _folder(usual, says):
    """Option of a folder; one that is a file or cannot be written is refused before the work."""
    return typer.Option(Path(usual), file_okay=False, writable=True, help=says)


OUT = _folder("runs/bench", "folder for the JSON file and the figure")
FORCE = typer.Option(False, "--force", help="replace the results of an earlier run")
QUICK = typer.Option(False, "--quick", help="small grids and few steps")
JSON = typer.Option(False, "--json", help="print the JSON object of the file to stdout instead of tables")
THREADS = typer.Option(None, help="CPU threads (default: all)")
WRITE = typer.Option(False, "--write", help="replace the suite's table in docs/performance.md (of the current folder)")
WORKERS = typer.Option(1, help="number of processes, which share the cores")

BARS = ("bars", "null", "hold, %", "ratio", "bar", "error")


def stability(
    context: typer.Context,
    out: Path = OUT,
    match: str = typer.Option("", help="run only the cases with this text in their name"),
    thermal: bool = typer.Option(False, "--thermal/--isothermal", help="run the table with temperatures"),
    random: int = typer.Option(200, help="number of random scenes after the table"),
    rough: int = typer.Option(0, help="number of random contacts of two ground surfaces, with temperatures, after them"),
    seed: int = typer.Option(0, help="seed of the random scenes"),
    quick: bool = typer.Option(False, "--quick", help="run every sixth case and eight random scenes"),
    only_starts: bool = typer.Option(False, "--starts", help="run only scenes with temperatures: the steady start and one "
                                                             "step"),
    by_film: bool = typer.Option(False, "--grid-by-film", help="choose the number of columns from the film formula"),
    confirm: bool = typer.Option(False, "--confirm", help="check the starts with temperatures against half the time step and "
                                                          "twice the columns"),
    again: int = typer.Option(0, min=0, max=6, help="with --confirm: largest number of doublings of a grid on which a start "
                                                    "does not hold, up to 2048 columns (point contacts: 256)"),
    finer: int = typer.Option(0, min=0, max=4, help="number of doublings of every grid before the runs, up to 2048 columns "
                                                    "(point contacts: 512)"),
    as_json: bool = JSON,
    force: bool = FORCE,
    write: bool = WRITE,
    threads: Optional[int] = THREADS,
    workers: int = WORKERS,
    precision: str = typer.Option("auto", help="precision of the linear solves: f32, f64 or auto (chosen for each scene)"),
):
    """Run stiff and extreme scenes; each converges, is refused, stops or fails. Example: `tehl bench stability`"""
    from tehl_taichi.profiles import stability as suite
    from tehl_taichi.profiles.stability import carried, cases, random_cases, rough_cases, run, starts

    results = Results(out, "starts" if confirm else "stability", force, write=write and not confirm)
    if confirm:
        say_idle(context, "--confirm takes all starts, each in its own precision", "only_starts", "precision")
        say_idle(context, "docs/performance.md has no table that --confirm writes", "write")
    else:
        say_idle(context, "it applies to --confirm only", "again")
    if not (random or rough):
        say_idle(context, "--random 0 draws no scenes", "seed")
    listed = list(cases(thermal).items())
    drawn = random_cases(min(random, 8) if quick else random, seed) | rough_cases(min(rough, 2) if quick else rough, seed)
    chosen = {name: description for name, description in (*listed[:: 6 if quick else 1], *drawn.items())
              if match.lower() in name.lower()}
    chosen = starts(chosen) if only_starts or confirm else chosen
    chosen, found = carried(chosen) if by_film else chosen, []
    chosen = suite.finer(chosen, finer)
    if confirm:
        return _confirm(results, chosen, as_json, workers, threads, again)
    for outcome in run(chosen.items(), precision, workers, threads):
        found.append(outcome)
        say(f"{outcome.name}: {outcome.verdict} {outcome.reason}")
    found.sort(key=lambda outcome: list(chosen).index(outcome.name))
    counts = _verdicts(found)
    results.documented(("scenes", *counts), [(kind, *map(str, _verdicts(part).values())) for kind, part in
                                             (("table", [o for o in found if o.name in dict(listed)]),
                                              ("random", [o for o in found if o.name not in dict(listed)
                                                          and not o.name.startswith("rough ")]),
                                              ("rough", [o for o in found if o.name.startswith("rough ")])) if part])
    counts["unsettled"] = sum(o.unsettled for o in found)
    counts["carried"] = sum(o.carried for o in found)
    counts["carried_converged"] = sum(o.carried and o.verdict == "converged" for o in found)
    if not as_json:
        table("stability" + (" with temperatures" if thermal else ""), [{**vars(o), "case": o.name} for o in found],
              {"case": "{}", "verdict": "{}", "steps": "{}", "newton": "{:.1f}", "cycles": "{:.0f}", "seconds": "{:.1f}",
               "Fi_max": "{:.3f}"})
    say("{converged} converged ({unsettled} of them from a start that did not settle), {refused} refused, {stopped} stopped, "
        "{failed} failed; {carried_converged} of {carried} whose film the grid carries converged".format(**counts))
    results.finish([vars(o) for o in found], lambda plt: suite.chart(plt, found), as_json, **counts)
    raise typer.Exit(1 if counts["failed"] else 0)


def _verdicts(outcomes):
    """{verdict: how many scenes end so}."""
    return {verdict: sum(o.verdict == verdict for o in outcomes) for verdict in ("converged", "refused", "stopped", "failed")}


def _confirm(results, chosen, as_json, workers, threads, again):
    from tehl_taichi.profiles import stability as suite

    found = []
    for one in suite.confirm(chosen, workers, threads, again):
        found.append({**vars(one), "holds": one.holds})
        changes = ", ".join(f"{key} {value:.2g}" for key, value in vars(one).items() if isinstance(value, float))
        say(f"{one.name}: {one.reason or f'{one.columns} columns, ' + (changes or 'stops')}")
    counts = {"starts": len(found), "holds": sum(one["holds"] for one in found),
              "moving": sum(one["holds"] and one["moving"] for one in found)}
    if not as_json:
        rows = [{**one, **{key: 100 * one[key] for key in ("half_film", "finer_film") if one[key] is not None}}
                for one in found]
        table("change by half the time step and by twice the columns: h_c in %, temperature in K", rows,
              {"name": "{}", "columns": "{}", **dict.fromkeys(("half_film", "half_K", "finer_film", "finer_K"), "{:.2f}")})
    say("{holds} of {starts} starts hold: neither changes their film by more than 1 %, nor their temperature by more than 1 K "
        "({moving} of them states in time)".format(**counts))
    results.finish(found, lambda plt: suite.changes_chart(plt, found), as_json, **counts)


def conclusions(
    out: Path = _folder("runs/conclusions", "folder of the stores and results (existing stores are reused)"),
    quick: bool = typer.Option(False, "--quick", help="run the reference asperity and dent on coarse grids"),
    columns: int = typer.Option(0, help="columns of the finest grid (128, 256, 512 for all cases; default: 512, the asperities "
                                        "and dents of 1.5 um 2048)", min=0),
    as_json: bool = JSON,
    force: bool = FORCE,
    threads: Optional[int] = THREADS,
    workers: int = WORKERS,
):
    """Check the conclusions of the thesis: Findley stress of both bodies by slip, feature, pressure and part of the passage.

    Example: `tehl bench conclusions --quick`
    """
    from tehl_cli.tables import list_table
    from tehl_taichi.profiles import conclusions as suite

    from tehl_taichi.scene import scene

    results = Results(out, "conclusions", force, more=("md",))
    rows = suite.run(out, quick, say, workers, threads, columns)
    base = scene("gear")
    judged = suite.verdicts(rows, base.fatigue.endurance)
    if not as_json:
        list_table("Findley stress, MPa", ("case", "body", *suite.WINDOWS),
                   [(r.name, r.body, *suite.cells(r)) for r in rows])
        list_table("the thesis' conclusions", ("statement", "verdict", "figures"), judged)
    results.page(suite.page(rows, judged, base))
    results.finish([suite.plain_row(r) for r in rows], lambda plt: suite.chart(plt, rows), as_json,
                   verdicts=[dict(zip(("statement", "verdict", "figures"), one)) for one in judged])


def verdict(
    out: Path = _folder("runs/verdict", "folder of the stores and results (existing stores are reused)"),
    quick: bool = typer.Option(False, "--quick", help="run the default asperity on 64 x 16 cells"),
    as_json: bool = JSON,
    force: bool = FORCE,
    threads: Optional[int] = THREADS,
    workers: int = WORKERS,
):
    """Compare the fatigue index without and with a case-hardened profile and residual stress. Example: `tehl bench verdict`"""
    from tehl_cli.tables import list_table
    from tehl_taichi.profiles import verdict as suite

    results = Results(out, "verdict", force, more=("md",))
    rows = suite.run(out, quick, say, workers, threads)
    if not as_json:
        list_table("fatigue index by strength", suite.COLUMNS, suite.texts(rows))
    say(suite.LEFT_OUT)
    results.page(suite.page(rows))
    results.finish([suite.plain_row(row) for row in rows], lambda plt: suite.chart(plt, rows), as_json, left_out=suite.LEFT_OUT)


def cracks(
    out: Path = _folder("runs/cracks", "folder of the stores and results (existing stores are reused)"),
    quick: bool = typer.Option(False, "--quick", help="run the reference asperity on coarse grids"),
    as_json: bool = JSON,
    force: bool = FORCE,
    threads: Optional[int] = THREADS,
    workers: int = WORKERS,
):
    """Compute crack paths from the loads of a passage, with errors. Example: `tehl bench cracks --quick`"""
    from tehl_cli.tables import list_table
    from tehl_taichi.profiles import cracks as suite
    from tehl_taichi.profiles import measure

    results = Results(out, "cracks", force, more=("md",))
    for rows in suite.run(out, quick, say, workers, threads):  # those so far are kept, whatever comes
        measure.save(out, "cracks", measure.result([vars(row) for row in rows]))
        results.page(suite.page(rows))
    if not as_json:
        list_table("crack paths", suite.COLUMNS, [(row.case, *suite.cells(row)) for row in rows])
    results.finish([vars(row) for row in rows], lambda plt: suite.chart(plt, rows), as_json)


def zoom(
    out: Path = _folder("runs/zoom", "folder of the stores and results (existing stores are reused)"),
    quick: bool = typer.Option(False, "--quick", help="run one line contact on coarse grids"),
    as_json: bool = JSON,
    force: bool = FORCE,
    write: bool = WRITE,
    threads: Optional[int] = THREADS,
):
    """Compare runs with a fine window to runs that are as fine everywhere. Example: `tehl bench zoom --quick`"""
    from tehl_cli.tables import list_table
    from tehl_taichi.profiles import measure
    from tehl_taichi.profiles import zoom as suite

    results = Results(out, "zoom", force, write=write)
    for rows in suite.run(out, quick, threads, say):  # those so far are kept, whatever comes
        measure.save(out, "zoom", measure.result([vars(row) for row in rows]))
    texts_of = [suite.cells(row) for row in rows]
    if not as_json:
        list_table("zoom: a fine window against a fine grid", suite.COLUMNS, texts_of)
    results.documented(suite.COLUMNS, texts_of)
    results.finish([{**vars(row), "off": row.off, "holds": row.holds} for row in rows], lambda plt: suite.chart(plt, rows),
                   as_json)


def accuracy(
    context: typer.Context,
    out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE,
    threads: Optional[int] = THREADS,
    only: Optional[str] = typer.Option(None, help="run only one part: errors (against run time), coverage (of the error bars), "
                                                  "exits (error bars of exits) or roughness (of rough surfaces, part of "
                                                  "coverage)"),
    seed: int = typer.Option(4, help="seed of the random scenes that check the error bars"),
    judge: bool = typer.Option(False, "--judge", help="evaluate the runs that `--out` already holds"),
    keep: bool = typer.Option(False, "--keep", help="write the errors into the package, for `--target-error`"),
):
    """Measure error against run time, the grid needed for 5, 1 and 0.1 %, and the coverage of the error bars.

    Examples: `tehl bench accuracy --quick` · `tehl bench accuracy --only coverage --threads 1`
    """
    from tehl_taichi.engine import runtime
    from tehl_taichi.values.checks import choice

    choice("--only", only, (None, "errors", "coverage", "exits", "roughness"))
    if judge or only not in (None, "errors"):
        say_idle(context, "no errors are computed", "keep")
    elif keep:
        _check_package()
    if judge or only == "errors":
        say_idle(context, "no random scenes are run", "seed")
    if only == "errors":
        say_idle(context, "no error bars are judged", "judge")
    runtime.start(threads=threads)
    found, name = {}, only if only in ("exits", "roughness") else "coverage"
    errors = Results(out, "accuracy", force, write=write) if only in (None, "errors") and not judge else None
    bars = Results(out, name, force, kept=("json",) if judge else (), write=write) if only != "errors" else None
    if errors:
        found["errors"] = _accuracy(errors, quick, as_json, keep)
    if bars:
        found[name] = _coverage(bars, seed, quick, judge, threads or _cores(), as_json)
    if as_json:
        print_json(found)


def _check_package():
    """Raises StoreError where the errors cannot be written into the package."""
    from tehl_taichi.errors import StoreError
    from tehl_taichi.scene import grid_for_error

    if not os.access(grid_for_error.FILE.parent, os.W_OK):
        raise StoreError(f"--keep: {grid_for_error.FILE} cannot be written")


def _accuracy(results, quick, as_json, keep):
    from tehl_cli.tables import list_table
    from tehl_taichi.profiles import accuracy as suite
    from tehl_taichi.profiles import measure

    rows = suite.run(quick, say)
    columns, runs = _errors(rows)
    results.documented(columns, runs)
    if not as_json:
        list_table("error, % (* no faster run has a smaller one)", columns, runs)
        list_table("columns needed for each "
                   "error", ("family", "quantity", "order", *(f"{target:g}" for target in suite.TARGETS)),
                   [(family, quantity, "none" if order is None else f"{order:.1f}", *(str(nx or "finer") for nx in grids))
                    for family, quantity, order, grids in suite.enough(rows)])
    results.finish(rows, lambda plt: suite.chart(plt, rows), False)
    if keep:
        from tehl_taichi.disk import files
        from tehl_taichi.scene import grid_for_error

        text = json.dumps({"machine": measure.machine(), "families": suite.grid_errors(rows)}, indent=1) + "\n"
        files.replace(grid_for_error.FILE, text.encode())
        say(f"wrote {grid_for_error.FILE}")
    return rows


def _coverage(results, seed, quick, judge, threads, as_json):
    from tehl_cli.tables import list_table
    from tehl_taichi.profiles import coverage as suite
    from tehl_taichi.profiles import measure

    from tehl_taichi.errors import StoreError

    path, name = results.file("json"), results.name
    if not judge:
        measure.fresh(threads, suite.run, path, seed, quick, say, name)
    elif not path.exists():
        raise StoreError(f"--judge: {path} does not exist. Run `tehl bench accuracy --only {name}` first")
    stored = json.loads(path.read_text())
    found = suite.table(stored["rows"])
    results.documented(("quantity", *BARS), [(f"{part} {what}", *_of_bars(*numbers)) for part, what, *numbers in found])
    for part, rows in () if as_json else itertools.groupby(found, lambda row: row[0]):
        list_table(f"{part}: error bars of random scenes (seed {stored['seed']}), checked on grids {suite.FINER} times as "
                   "fine;\nmedians of bar/error, bar and error (relative, in K, or of shares themselves)",
                   ("quantity", *BARS), [(what, *_of_bars(*numbers)) for _, what, *numbers in rows])
    for one in stored["rows"]:
        if "reason" in one:
            say(f"{one['kind']} skipped: {one['reason']}")
    say(f"wrote {path}")
    results.picture(lambda plt: suite.chart(plt, found))
    return [dict(zip(suite.COLUMNS, row)) for row in found]


def _of_bars(known, unknown, *numbers):
    """Texts of the columns BARS."""
    return str(known), str(unknown), *(_short(value, factor) for value, factor in zip(numbers, (100, 1, 1, 1)))


def _short(value, factor):
    return "" if value is None else f"{factor * value:.2g}" if factor == 1 else f"{factor * value:.1f}"


def _errors(rows):
    """(columns, a line per run with its error in each quantity; * where no faster run of the family has a smaller one)."""
    quantities = list(dict.fromkeys(row["quantity"] for row in rows))
    runs: dict[tuple, dict] = {}
    for row in rows:
        run = runs.setdefault((row["family"], row.get("setting", row["columns"])), {"s": f"{row['seconds']:.2f}"})
        run[row["quantity"]] = f"{100 * row['error']:.2g}{'*' if row['front'] else ' '}"
    return ("family", "run", "s", *quantities), [(family, str(name), *(run.get(key, "") for key in ("s", *quantities)))
                                                 for (family, name), run in runs.items()]


def speed(out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE,
          threads: Optional[int] = THREADS):
    """Measure run times against their targets, and reference loops to compare machines. Example: `tehl bench speed --quick`"""
    from tehl_taichi.profiles import speed as suite

    results = Results(out, "speed", force, write=write)
    rows = suite.run(quick, threads or _cores(), say)
    details = {"step_ms": "step {:.1f} ms", "convolutions": "{:.0f} convolutions", "cycles": "{:.1f} Krylov",
               "memory_mb": "{:.0f} MB", "planes_per_s_core": "{:.2g} planes/s core"}
    shown = [{**row, "detail": ", ".join(form.format(row[key]) for key, form in details.items() if key in row)} for row in rows]
    columns = {"what": "{}", "seconds": "{:.3f}", "target": "{:g}", "detail": "{}"}
    if not as_json:
        table("speed", shown, columns)
    results.documented(columns, texts(shown, columns))
    results.finish(rows, lambda plt: suite.chart(plt, rows), as_json)


def scaling(out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE,
            threads: Optional[int] = THREADS,
            thermal: bool = typer.Option(False, "--thermal/--isothermal", help="with or without temperatures")):
    """Measure time and memory against grid size and threads. Example: `tehl bench scaling --quick`"""
    from tehl_taichi.profiles import scaling as suite

    results = Results(out, "scaling", force, write=write)
    rows = suite.run(quick, threads or _cores(), thermal, say)
    columns = {"nx": "{}", "ny": "{}", "threads": "{}", "step_ms": "{:.1f}", "speed_up": "{:.2f}", "node_ns": "{:.0f}",
               "newton": "{:.1f}", "cycles": "{:.1f}", "memory_mb": "{:.0f}", "node_B": "{:.0f}"}
    if not as_json:
        table("scaling", rows, columns)
    results.documented(columns, texts(rows, columns))
    results.finish(rows, lambda plt: suite.chart(plt, rows), as_json)


def sweep(out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE,
          workers: Optional[int] = typer.Option(None, min=1, help="largest number of workers (default: one per core)")):
    """Measure the speed-up of a sweep of 16 cases on 1, 2, 4 ... workers. Example: `tehl bench sweep --workers 2`"""
    from tehl_taichi.profiles import side_by_side as suite

    results = Results(out, "sweep", force)
    rows = suite.run(quick, workers, say)
    if not as_json:
        table("cases in parallel", rows, {"workers": "{}", "seconds": "{:.1f}", "cases_s": "{:.1f}", "speed_up": "{:.2f}"})
    results.finish(rows, lambda plt: suite.chart(plt, rows), as_json)


def profile(out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE,
            threads: Optional[int] = THREADS,
            thermal: bool = typer.Option(True, "--thermal/--isothermal", help="with or without temperatures")):
    """Measure the time of a step per stage and per kernel. Example: `tehl bench profile --isothermal`"""
    from tehl_taichi.profiles import measure
    from tehl_taichi.profiles import profile as suite

    results = Results(out, "profile", force, write=write)
    stages, kernels, numbers = measure.fresh(threads or _cores(), suite.run, *(suite.QUICK if quick else suite.FULL), thermal)
    columns = {"what": "{}", "calls": "{:.1f}", "ms": "{:.2f}", "limit_ms": "{:.2f}", "MB": "{:.1f}"}
    results.documented(columns, texts(stages, columns))
    if not as_json:
        table("stages, per step (a stage may contain others)", stages, columns)
        table("kernels, per step", kernels, columns)
    say(", ".join(f"{key} {value:.3f}" for key, value in numbers.items()))
    say("largest possible gains, ms per step: " + ", ".join(f"{what} {ms:.1f}" for what, ms in suite.gaps(stages, kernels)))
    rows = [{"kind": kind, **row} for kind, part in (("stage", stages), ("kernel", kernels)) for row in part]
    results.finish(rows, lambda plt: suite.chart(plt, stages, kernels, numbers["step_s"]), as_json, **numbers)


def _cores():
    from tehl_taichi.engine.cores import available

    return available()
