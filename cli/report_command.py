"""tehl report: one HTML page of a run, study, flank, bearing or cam."""

from pathlib import Path
from typing import Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.fatigue_options import with_fatigue_options
from tehl_cli.idle_options import say_idle
from tehl_cli.live_display import Live
from tehl_cli.stdout import put

import tehl_taichi as tehl


@with_fatigue_options
def report(
    store: Path = typer.Argument(..., help="store of a run (finished or not), a study, or the folder of a flank, bearing "
                                           "or cam"),
    context: typer.Context = None,
    out: Optional[Path] = typer.Option(None, help="HTML file to write (default: beside the store; with other fatigue "
                                                  "constants: STORE-fatigue.html)"),
    force: usual.Force = False,
    open_: bool = typer.Option(False, "--open/--no-open", help="open the report in the browser"),
    pages: bool = typer.Option(False, "--pages", help="flank or cam: also write the page of every position, linked from this "
                                                      "one (some MB each)"),
    threads: Optional[int] = typer.Option(None, help="CPU threads for a search with other constants (default: all)"),
    **constants,
):
    """Write one HTML page to send to a colleague: verdict, scene, interactive figures, errors and origin.

    The page needs no other file and no network. Options of `tehl fatigue` give the page of that fatigue search.

    Examples: `tehl report runs/gear-1.zarr --open` · `tehl report runs/fzg-c-1 --out flank.html` ·
    `tehl report runs/gear-1.zarr --bending-limit 600e6 --torsion-limit 390e6 --to-x 0.5`
    """
    from tehl_taichi.engine import runtime

    runtime.check(threads=threads)
    if all(value is None for value in constants.values()):
        say_idle(context, "only a search with other constants computes", "threads")
    with Live() as live:
        path = tehl.report(store, out, force=force, progress=live, threads=threads, pages=pages, **constants)
    put(path)
    if open_:
        typer.launch(path.absolute().as_uri())
