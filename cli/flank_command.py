"""tehl flank: contact, film and fatigue along a gear flank."""

from pathlib import Path
from typing import List, Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.amount import amount, number
from tehl_cli.idle_options import say_no_figure
from tehl_cli.live_display import Live, say
from tehl_cli.missing_results import refuse_missing
from tehl_cli.scene_options import changes_of, check_rows
from tehl_cli.stdout import print_json
from tehl_cli.tables import print_places

import tehl_taichi as tehl


def flank(
    gear: str = typer.Argument("fzg-c", help="fzg-c, fzg-a, a TOML file, or a table of positions (CSV)"),
    context: typer.Context = None,
    torque: Optional[float] = number("torque of the pinion, N m"),
    speed: Optional[float] = number("speed of the pinion, 1/min"),
    on: Optional[str] = typer.Option(None, help="flank that carries the feature: pinion (default) or gear"),
    positions: Optional[int] = typer.Option(None, help="number of positions, including the points A to E and two beside C "
                                                           "(default: 11)"),
    at: Optional[List[str]] = typer.Option(None, help="one position instead: a point (C, B-) or a distance past C in m; "
                                                      "repeatable"),
    scene: usual.Base = None,
    steady: bool = typer.Option(False, "--steady", help="steady contacts without a feature"),
    oil: usual.Oil = None, temperature: usual.Temperature = None,
    height: usual.Height = None, width: usual.FeatureWidth = None,
    thermal: usual.Thermal = None, set_: usual.SetInScenes = None, grid: usual.Grid = None,
    out: Optional[Path] = typer.Option(None, help="folder to write (default: runs/NAME-N); an existing flank is resumed"),
    figure: bool = typer.Option(True, "--figure/--no-figure", help="draw flank.png (.pdf, .svg) in that folder"),
    format: usual.Format = "png", dpi: usual.Dpi = 160, figure_width: usual.FigureWidth = 17.0,
    workers: Optional[int] = typer.Option(None, help="number of positions computed at the same time, one process each "
                                                     "(default: one per core)"),
    threads: Optional[int] = typer.Option(None, help="CPU threads per position (default: the cores that --workers leaves, or "
                                                     "1)"),
    as_json: usual.AsJson = False, quiet: usual.Quiet = False, curves: usual.CurvesOfOne = True,
):
    """Compute the contacts along a gear flank: film, pressure, temperature, friction and fatigue at each position.

    Examples: `tehl flank fzg-c --torque 265.1` · `tehl flank my_gears.toml --on gear --steady` · `tehl flank table.csv`
    """
    from tehl_taichi.store.load_scene import find
    from tehl_taichi.view.figures import folder_figure
    from tehl_taichi.view.figures.figure_style import FigureStyle

    page = FigureStyle(format, dpi, figure_width, force=True)
    folder_figure.check(out, page, "flank") if figure else say_no_figure(context, "--no-figure draws none")
    options = {"oil.name": oil, "temperature": temperature, "height": height, "width": width, "thermal.on": thermal}
    changes = changes_of(options, grid, set_ or [])
    base = find(scene) if scene else None
    check_rows(grid, changes, lambda: _line(gear, base, changes, steady))
    with Live(quiet, curves) as live:
        found = tehl.flank(gear, torque=torque, speed=speed, on=on, positions=positions, at=[_place(text) for text in at or ()],
                           scene=base, changes=changes, steady=steady, folder=out, workers=workers,
                           threads=threads, progress=live)
    if figure:
        say(str(found.plot(**vars(page))))
    print_json(found.to_dict()) if as_json else print_flank(found)
    refuse_missing(found.failed, len(found.positions), "position", found.folder)


def _line(gear, base, changes, steady):
    """Scene changes for all positions: a line contact."""
    from math import inf

    from tehl_taichi.runs.flank.flank_source import flank_source

    passes = {"time.steady_only": True} if steady else {}
    found = base or flank_source(gear).scene
    loaded = {} if found.contact.kind == "line" else {"contact.hertz_pressure": 1e9}  # each position has its own
    return found.replace(**{"contact.kind": "line", "contact.radius_y": inf, **loaded, **changes, **passes})


def _place(text):
    """A coordinate in m, or the name of a point."""
    from tehl_taichi.values.units import in_unit

    return in_unit("--at", amount(text), "m")


def print_flank(found):
    """Print a flank."""
    from tehl_taichi.report import flank_page
    from tehl_taichi.runs.flank.flank_columns import tables

    print_places(found, tables(found.rows), flank_page.answer(found), flank_page.no_film_words(found),
                 [f"load: {found.record['load_sharing']}"])
