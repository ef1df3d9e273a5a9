"""tehl report: one HTML page of a run, a study or a flank."""

from pathlib import Path
from typing import Optional

import typer


def register(app):
    """Add the command to the app."""
    app.command()(report)


def report(
    store: Path = typer.Argument(..., help="store of a run (finished or not), a study, or the folder of a flank"),
    out: Optional[Path] = typer.Option(None, help="HTML file to write (default: beside the store)"),
    force: bool = typer.Option(False, "--force", help="replace a file that is there"),
    open_: bool = typer.Option(False, "--open/--no-open", help="show it in the browser"),
):
    """One HTML page to send to a colleague: the answer and how sure it is, the scene, figures to zoom, errors, origin.

    It needs no other file and no network.

    Examples: `tehl report runs/gear-1.zarr --open` · `tehl report runs/fzg-c-1 --out flank.html`
    """
    import tehl_taichi as tehl

    path = tehl.report(store, out, force=force)
    print(path)
    if open_:
        typer.launch(path.absolute().as_uri())
