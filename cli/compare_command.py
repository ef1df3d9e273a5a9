"""tehl compare: runs side by side."""

from pathlib import Path
from typing import List, Optional

import typer
from tehl_cli.figure_options import Dpi, Force, Format, Width
from tehl_cli.live_display import say
from tehl_cli.stdout import print_json, put

LONG = 60  # letters of a value, as of the contents of a table


def register(app):
    """Add the command to the app."""
    app.command()(compare)


def compare(
    stores: List[Path] = typer.Argument(..., help="stores of two or more runs, finished or not"),
    at: float = typer.Option(0.0, help="position of the feature in the centreline plots, in half-widths a"),
    out: Optional[Path] = typer.Option(None, help="figure to write: .png, .pdf or .svg (default: compare.png beside the first "
                                                  "store)"),
    format: Format = "png",
    dpi: Dpi = 160,
    width: Width = 17.0,
    force: Force = False,
    as_json: bool = typer.Option(False, "--json", help="print one JSON object to stdout"),
):
    """Compare runs: differences between scenes and results, and one figure of centrelines, histories and Fi.

    Example: `tehl compare runs/gear-1.zarr runs/gear-2.zarr`
    """
    from tehl_taichi.runs.compare import compare as side_by_side
    from tehl_taichi.values.checks import number

    number("--at", at, "a", -20.0, 20.0)
    found = side_by_side(*stores)
    figure = found.plot(out or stores[0].parent / "compare", at, dpi, format, width, force)
    if as_json:
        print_json({**found.to_dict(), "figure": str(figure)})
        return
    _scenes(found)
    _results(found)
    say(str(figure))


def _scenes(found):
    from tehl_cli.tables import list_table

    if not found.differs:
        return put("the scenes are identical")
    rows = [(key, *map(_shown, values)) for key, values in found.differs.items()]
    list_table("differences between the scenes", ("key", *found.names), rows, whole=True)


def _results(found):
    """The rows that differ, with the change where two runs are compared; then those that do not, as a line."""
    from tehl_cli.tables import list_table

    pair, lines = len(found.names) == 2, found.lines
    rows = [(line.what, *line.values, *[line.change] * pair) for line in lines if not line.same]
    if rows:
        list_table("differences between the results", ("quantity", *found.names, *["change"] * pair), rows, whole=True)
    if same := [f"{line.what} {line.values[0]}" for line in lines if line.same]:
        put(f"equal in all: {'; '.join(same)}")


def _shown(value):
    text = "-" if value is None else f"{value:.5g}" if isinstance(value, float) else " ".join(str(value).split())
    return text if len(text) <= LONG else f"{text[:LONG]} ..."
