"""tehl cam: the contact of a cam and its follower over the cycle."""

from pathlib import Path
from typing import Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.bearing_features import feature_of
from tehl_cli.idle_options import say_no_figure
from tehl_cli.live_display import Live, say
from tehl_cli.missing_results import refuse_missing
from tehl_cli.scene_options import changes_of
from tehl_cli.stdout import print_json
from tehl_cli.tables import print_places

import tehl_taichi as tehl


def cam(
    table: Path = typer.Argument(..., help="CSV: angle_deg, load_N_per_mm, R_mm (or R_a_mm and R_b_mm), u_a_m_s, u_b_m_s"),
    context: typer.Context = None,
    oil: usual.Oil = None, temperature: usual.Temperature = None,
    dent: Optional[str] = typer.Option(None, help="dent of the cam that passes: DEPTH,WIDTH,rim=HEIGHT in m"),
    scan: Optional[Path] = typer.Option(None, help="file of measured heights of the cam that pass"),
    unit: usual.Unit = None, pixel: usual.Pixel = None,
    scene: usual.Base = None, steady: usual.Smooth = False,
    thermal: usual.UsuallyThermal = None, set_: usual.SetInScenes = None,
    grid: Optional[str] = typer.Option(None, help="coarse, medium, fine or NXxNY"),
    out: Optional[Path] = typer.Option(None, help="folder to write (default: runs/NAME-N); an existing cam is resumed"),
    figure: bool = typer.Option(True, "--figure/--no-figure", help="draw cam.png (.pdf, .svg) in that folder"),
    format: usual.Format = "png", dpi: usual.Dpi = 160, figure_width: usual.FigureWidth = 17.0,
    workers: Optional[int] = typer.Option(None, help="number of angles computed at the same time (default: one per core)"),
    threads: Optional[int] = typer.Option(None, help="CPU threads per angle (default: the cores that --workers leaves, or 1)"),
    as_json: usual.AsJson = False, quiet: usual.Quiet = False, curves: usual.CurvesOfOne = True,
):
    """Compute the line contacts of a cam over its cycle: film, pressure, temperature and friction at each angle of a table.

    Examples: `tehl cam cam.csv --oil mineral-vg100 --temperature 90` · `tehl cam cam.csv --dent 2e-6,0.2e-3,rim=0.3e-6`
    """
    from tehl_taichi.store.load_scene import find
    from tehl_taichi.view.figures import folder_figure
    from tehl_taichi.view.figures.figure_style import FigureStyle

    feature = feature_of(dent, scan, unit, pixel)
    page = FigureStyle(format, dpi, figure_width, force=True)
    folder_figure.check(out, page, "cam") if figure else say_no_figure(context, "--no-figure draws none")
    changes = changes_of({"oil.name": oil, "temperature": temperature, "thermal.on": thermal}, grid, set_ or [])
    with Live(quiet, curves) as live:
        found = tehl.cam(table, feature=feature, scene=find(scene) if scene else None, changes=changes, steady=steady,
                         folder=out, workers=workers, threads=threads, progress=live)
    if figure:
        say(str(found.plot(**vars(page))))
    print_json(found.to_dict()) if as_json else print_cam(found)
    refuse_missing(found.not_converged, len(found.rows), "angle", found.folder)


def print_cam(found):
    """Print a cam."""
    from tehl_taichi.report import cam_page
    from tehl_taichi.runs.cam.cam_columns import tables

    print_places(found, tables(found.rows), cam_page.answer(found))
