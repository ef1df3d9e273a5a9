"""Options that several suites of tehl bench share."""

from pathlib import Path
from typing import Annotated

import typer
from tehl_cli import usual_options as usual


def folder(usual, says):
    """Option for a folder; a file or a folder without write permission is refused before the work."""
    return typer.Option(Path(usual), file_okay=False, writable=True, help=says)


OUT = folder("runs/bench", "folder for the JSON file and the figure")
FORCE = typer.Option(False, "--force", help="replace the results of an earlier run")
QUICK = typer.Option(False, "--quick", help="small grids and few steps")
JSON = typer.Option(False, "--json", help="print the JSON object of the file to stdout instead of tables")
THREADS = typer.Option(None, min=1, max=1024, help=usual.ALL_CORES)
Heat = Annotated[bool, typer.Option("--thermal/--isothermal", help="with or without temperatures")]
WRITE = typer.Option(False, "--write", help="replace the suite's table in docs/performance.md (of the current folder)")
WORKERS = typer.Option(1, min=1, help="number of processes, which share the cores")
