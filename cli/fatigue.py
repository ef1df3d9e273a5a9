"""tehl fatigue: the fatigue pass over a store, again and with other constants."""

from pathlib import Path
from typing import Optional

import typer
from tehl_cli.figure_options import Dpi, Format, Width
from tehl_cli.live import Live, say
from tehl_cli.out import print_json

from tehl_taichi.criteria import CRITERIA


def register(app):
    """Add the command to the app."""
    app.command()(fatigue)


def fatigue(
    store: Path = typer.Argument(..., help="store of a run with a feature, finished or not"),
    kappa: Optional[float] = typer.Option(None, help="sensitivity to normal stress"),
    endurance: Optional[float] = typer.Option(None, help="sigma_eF, Pa"),
    bending_limit: Optional[float] = typer.Option(None, help="fatigue limit in reversed bending, Pa (with --torsion-limit)"),
    torsion_limit: Optional[float] = typer.Option(None, help="the same in torsion: both give kappa, sigma_eF"),
    criterion: Optional[str] = typer.Option(None, help=", ".join(CRITERIA)),
    depths: Optional[str] = typer.Option(None, help="auto (the worst depth under the feature), none, or depths at which "
                                         "all points are searched, m, as 50e-6,100e-6"),
    from_x: Optional[float] = typer.Option(None, help="only moments with the feature beyond this position, a"),
    to_x: Optional[float] = typer.Option(None, help="only moments with the feature before this position, a"),
    thermal_stress: Optional[bool] = typer.Option(None, "--thermal-stress/--no-thermal-stress",
                                                  help="stress of the heat (default: where there is heat)"),
    residual_xx: Optional[float] = typer.Option(None, help="constant residual stress along x, Pa"),
    residual_yy: Optional[float] = typer.Option(None, help="the same along y, Pa"),
    figures: Optional[Path] = typer.Option(None, help="folder for figures"),
    format: Format = "png",
    dpi: Dpi = 160,
    width: Width = 17.0,
    threads: Optional[int] = typer.Option(None, help="CPU threads (default: all)"),
    as_json: bool = typer.Option(False, "--json", help="one JSON object on stdout"),
):
    """Fatigue of a stored passage; the store stays as it is.

    Example: `tehl fatigue runs/gear-1.zarr --kappa 0.25 --endurance 450e6 --to-x 0.5`
    """
    from tehl_taichi.engine import runtime
    from tehl_taichi.figures.page import Page
    from tehl_taichi.results.opened import open_run
    from tehl_taichi.scene.scales import Scales

    runtime.check(threads=threads)
    page = Page(format, dpi, width)
    run = open_run(store)
    with Live() as live:
        result = run.fatigue(kappa=kappa, endurance=endurance, bending_limit=bending_limit, torsion_limit=torsion_limit,
                             criterion=criterion, depths=_depths(depths), from_x=from_x, to_x=to_x,
                             thermal_stress=thermal_stress, residual_xx=residual_xx, residual_yy=residual_yy, threads=threads,
                             progress=live)
    _show(result, as_json)
    if figures:
        from tehl_taichi.figures.run_figures import write_fatigue

        for path in write_fatigue(result, run.scene.name, Scales.of(run.scene).a, figures, page):
            say(str(path))


def _depths(text):
    from tehl_taichi.scene import SceneError

    if text in (None, "auto", "none"):
        return [] if text == "none" else text
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise SceneError(f"--depths {text!r} must be auto, none or numbers in m with commas between, as 50e-6,1e-4") from None


def _show(result, as_json):
    from tehl_cli.listing import list_table

    from tehl_taichi.io.summary_rows import fatigue_rows

    if as_json:
        print_json(result.summary)
    else:
        list_table("fatigue", ("quantity", "value"), fatigue_rows(result.summary))
