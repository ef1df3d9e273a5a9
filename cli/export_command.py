"""tehl export: stored runs as files for other tools."""

from pathlib import Path
from typing import List, Optional

import typer
from tehl_cli.amount import amount, metres
from tehl_cli.stdout import put

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError


def export(
    store: Path = typer.Argument(..., help="store of a run, finished or not"),
    format: str = typer.Option("csv", "--format", help="csv (tables), netcdf (one file) or vtk (a time series for ParaView)"),
    at: Optional[List[float]] = typer.Option(None, help="csv: centreline with the feature at this position, in half-widths a "
                                                        "(default: 0); repeatable"),
    point: Optional[List[str]] = typer.Option(None, help="csv: history of the point X,Y of the surface with the first "
                                                         "feature, m (as x_m, y_m in the fatigue summary); repeatable"),
    out: Optional[Path] = typer.Option(None, help="file or folder to write (default: beside the store)"),
    force: bool = typer.Option(False, "--force", help="replace an earlier export"),
):
    """Export a stored run as CSV tables, NetCDF or VTK, and print the path.

    Examples: `tehl export runs/gear-1.zarr --at -0.5 --at 0.5 --point=-37e-6,0` · `tehl export runs/gear-1.zarr --format vtk`
    """
    from tehl_taichi.runs.open_results import open_run

    points = [_point(text) for text in point or ()] or ()
    put(tehl.export(open_run(store), format, out, at=at or (), point=points, force=force))


def _point(text):
    parts = [amount(part) for part in text.split(",")]
    if len(parts) != 2:
        raise SceneError(f"--point {text!r} must be two numbers in m, separated by a comma, as -37e-6,0 or -37um,0")
    return tuple(metres("--point", part) for part in parts)
