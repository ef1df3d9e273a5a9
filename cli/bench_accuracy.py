"""tehl bench accuracy: error against run time, and the coverage of the error bars."""

import itertools
import json
import os
from pathlib import Path
from typing import Optional

import typer
from tehl_cli.bench_options import FORCE, JSON, OUT, QUICK, THREADS, WRITE
from tehl_cli.idle_options import say_idle
from tehl_cli.live_display import say
from tehl_cli.stdout import print_json
from tehl_cli.suite_results import Results

from tehl_taichi.engine.cores import available
from tehl_taichi.errors import StoreError

BARS = ("bars", "null", "hold, %", "ratio", "bar", "error")


def accuracy(
    context: typer.Context,
    out: Path = OUT, quick: bool = QUICK, as_json: bool = JSON, force: bool = FORCE, write: bool = WRITE,
    threads: Optional[int] = THREADS,
    only: Optional[str] = typer.Option(None, help="run only one part: errors (against run time), coverage (of the error bars), "
                                                  "exits (error bars of exits) or roughness (of rough surfaces, part of "
                                                  "coverage)"),
    seed: int = typer.Option(4, min=0, help="seed of the random scenes that check the error bars"),
    judge: bool = typer.Option(False, "--judge", help="evaluate the runs that `--out` already holds"),
    keep: bool = typer.Option(False, "--keep", help="write the errors into the package, for `--target-error`"),
):
    """Measure error against run time, the grid needed for 5, 1 and 0.1 %, and the coverage of the error bars.

    Examples: `tehl bench accuracy --quick` · `tehl bench accuracy --only coverage --threads 1`
    """
    from tehl_taichi.profiles.coverage import PARTS

    from tehl_taichi.engine import runtime
    from tehl_taichi.values.checks import choice

    choice("--only", only, (None, "errors", *PARTS))
    if judge or only not in (None, "errors"):
        say_idle(context, "no errors are computed", "keep")
    elif keep:
        _check_package()
    if judge or only == "errors":
        say_idle(context, "no random scenes are run", "seed")
    if only == "errors":
        say_idle(context, "no error bars are judged", "judge")
    runtime.start(threads=threads)
    found, name = {}, only if only and only != "errors" else "coverage"
    errors = Results(out, "accuracy", force, as_json, write=write) if only in (None, "errors") and not judge else None
    bars = None if only == "errors" else Results(out, name, force, as_json, kept=("json",) if judge else (), write=write)
    if errors:
        found["errors"] = _accuracy(errors, quick, keep)
    if bars:
        found[name] = _coverage(bars, seed, quick, judge, threads or available())
    if as_json:
        print_json(found)


def _check_package():
    """Raise StoreError if the errors cannot be written into the package."""
    from tehl_taichi.scene import grid_for_error

    if not os.access(grid_for_error.FILE.parent, os.W_OK):
        raise StoreError(f"--keep: {grid_for_error.FILE} cannot be written")


def _accuracy(results, quick, keep):
    from tehl_taichi.profiles import accuracy as suite
    from tehl_taichi.profiles import measure

    rows = suite.run(quick, say)
    columns, runs = _errors(rows)
    results.documented(columns, runs)
    results.table("error, % (* no faster run has a smaller one)", columns, runs)
    results.table("columns needed for each error",
                  ("family", "quantity", "order", *(f"{target:g}" for target in suite.TARGETS)),
                  [(family, quantity, "none" if order is None else f"{order:.1f}", *(str(nx or "finer") for nx in grids))
                   for family, quantity, order, grids in suite.enough(rows)])
    results.write_files(rows, lambda plt: suite.chart(plt, rows))
    if keep:
        from tehl_taichi.disk import files
        from tehl_taichi.scene import grid_for_error

        text = json.dumps({"machine": measure.machine(), "families": suite.grid_errors(rows)}, indent=1) + "\n"
        files.replace(grid_for_error.FILE, text.encode())
        say(f"wrote {grid_for_error.FILE}")
    return rows


def _coverage(results, seed, quick, judge, threads):
    from tehl_taichi.profiles import coverage as suite
    from tehl_taichi.profiles import measure

    path, name = results.file("json"), results.name
    if not judge:
        measure.fresh(threads, suite.run, path, seed, quick, say, name)
    elif not os.path.exists(path):
        raise StoreError(f"--judge: {path} does not exist. Run `tehl bench accuracy --only {name}` first")
    stored = json.loads(path.read_text())
    found = suite.table(stored["rows"])
    results.documented(("quantity", *BARS), [(f"{part} {what}", *_of_bars(*numbers)) for part, what, *numbers in found])
    for part, rows in itertools.groupby(found, lambda row: row[0]):
        results.table(f"{part}: error bars of random scenes (seed {stored['seed']}), checked on grids {suite.FINER} times as "
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
    """(columns, a line per run with its error in each quantity; * if no faster run of the family has a smaller error)."""
    quantities = list(dict.fromkeys(row["quantity"] for row in rows))
    runs: dict[tuple, dict] = {}
    for row in rows:
        run = runs.setdefault((row["family"], row.get("setting", row["columns"])), {"s": f"{row['seconds']:.2f}"})
        run[row["quantity"]] = f"{100 * row['error']:.2g}{'*' if row['front'] else ' '}"
    return ("family", "run", "s", *quantities), [(family, str(name), *(run.get(key, "") for key in ("s", *quantities)))
                                                 for (family, name), run in runs.items()]
