"""tehl animate: a run as a film."""

import sys
from pathlib import Path
from typing import Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.live_display import say
from tehl_cli.stdout import put

import tehl_taichi as tehl


def animate(
    store: Path = typer.Argument(..., help="store of a run with a feature, finished or not"),
    out: Optional[Path] = typer.Option(None, help="file to write (default: beside the store)"),
    format: Optional[str] = typer.Option(None, help="gif or mp4 (mp4 needs ffmpeg); default: the ending of `--out`, else gif"),
    frames: int = typer.Option(120, help="largest number of frames, spread evenly over the passage, 2 to 2000"),
    fps: int = typer.Option(15, help="frames per second, 1 to 50"),
    shown: str = typer.Option("film", "--map", help="map below the curves: film, pressure or temperature"),
    dpi: usual.Dpi = 110,
    width: usual.Width = 17.0,
    force: usual.Force = False,
    quiet: usual.Quiet = False,
):
    """Write a GIF or MP4 of the passage: pressure, film and temperatures along the centreline, with a map below.

    Examples: `tehl animate runs/gear-1.zarr` · `tehl animate runs/gear-1.zarr --out film.mp4 --map pressure --fps 25`
    """
    with FrameBar(quiet) as bar:
        path = tehl.animate(store, out, format=format, frames=frames, fps=fps, dpi=dpi, width=width, shown=shown, force=force,
                            progress=bar.show)
    put(path)


class FrameBar:
    """Progress on stderr: a bar in a terminal, otherwise a line for every quarter."""

    def __init__(self, quiet):
        self.quiet, self.bar = quiet, None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.bar:
            self.bar.stop()

    def show(self, done, total):
        """Print that `done` of `total` frames are drawn."""
        if self.quiet:
            return
        if not sys.stderr.isatty():
            if done * 4 // total > (done - 1) * 4 // total and done:
                say(f"frame {done} of {total}")
            return
        self.bar = self.bar or self._started(total)
        self.bar.update(self.task, completed=done)

    def _started(self, total):
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

        bar = Progress(TextColumn("frame"), MofNCompleteColumn(), BarColumn(), TimeRemainingColumn(),
                       console=Console(stderr=True))
        self.task = bar.add_task("", total=total)
        bar.start()
        return bar
