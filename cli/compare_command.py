"""tehl compare: comparison of runs, flanks, bearings, cams or studies."""

import os
from pathlib import Path
from typing import Any, List, Optional

import typer
from tehl_cli import usual_options as usual
from tehl_cli.idle_options import say_idle
from tehl_cli.live_display import say
from tehl_cli.stdout import print_json, put
from tehl_cli.tables import list_table

from tehl_taichi.errors import SceneError
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.file_ending import ending

LONG = 60  # letters of a value, as of the contents of a table


def compare(
    stores: List[Path] = typer.Argument(..., help="stores of two or more runs, finished or not; or folders of flanks, bearings "
                                                  "or cams, or studies over the same keys"),
    context: typer.Context = None,
    at: float = typer.Option(0.0, help="runs: position of the feature in the centreline plots, in half-widths a"),
    out: Optional[Path] = typer.Option(None, help="figure to write: .png, .pdf or .svg (default: compare.png, compare-2.png "
                                                  "... beside the first store)"),
    format: usual.Format = "png", dpi: usual.Dpi = 160, width: usual.Width = 17.0, force: usual.Force = False,
    as_json: usual.AsJson = False,
):
    """Compare results of one kind: differences between settings and results with their error bars, and one figure.

    Runs: centrelines, histories and Fi. Flanks, bearings, cams, studies: a table by position, curves over one axis.

    Examples: `tehl compare runs/gear-1.zarr runs/gear-2.zarr` · `tehl compare runs/vg220 runs/vg320`
    """
    from tehl_taichi.runs.compare import Comparison
    from tehl_taichi.runs.compare import compare as side_by_side
    from tehl_taichi.values.checks import number

    number("--at", at, "a", -20.0, 20.0)
    _check_format(context, out, format)
    found: Any = side_by_side(*stores)
    place, page = out or _free_figure(stores[0].parent, format, force), dict(dpi=dpi, format=format, width=width, force=force)
    if isinstance(found, Comparison):
        figure = found.plot(place, at, **page)
    else:
        say_idle(context, f"it applies to runs, and {stores[0]} is a {found.kind}", "at")
        figure = found.plot(place, **page)
    if as_json:
        print_json({**found.to_dict(), "figure": str(figure)})
        return
    _scenes(found)
    _results(found) if isinstance(found, Comparison) else _places(found)
    say(str(figure))


def _check_format(context, out, format):
    """Refuse a typed --format that the ending of --out contradicts. SceneError."""
    typed = context and context.get_parameter_source("format").name == "COMMANDLINE"
    if typed and out and ending(out) not in ("", f".{format}"):
        raise SceneError(f"--out {out} does not end in .{format}; omit --format, or choose another --out")


def _free_figure(folder, format, force):
    """First of compare, compare-2 ... in the folder without a figure of this format."""
    names = ("compare", *(f"compare-{n}" for n in range(2, 1000)))
    return folder / next((name for name in names if force or not os.path.lexists(folder / f"{name}.{format}")), "compare")


def _scenes(found):
    if missing := found.without_settings:
        put(f"settings of the contacts in {' and '.join(missing)} are not known: nothing is stored there")
    if not found.differs:
        return None if missing else put("the settings are identical")
    rows = [(_with_unit(key), *map(_shown, values)) for key, values in found.differs.items()]
    list_table("differences between the settings", ("key", *found.names), rows, whole=True)


def _results(found):
    """Print the rows that differ, with the change between two runs; then one line with those that do not."""
    pair, lines = len(found.names) == 2, found.lines
    rows = [(line.what, *line.values, *[line.change] * pair) for line in lines if not line.same]
    if rows:
        list_table("differences between the results", ("quantity", *found.names, *["change"] * pair), rows, whole=True)
    _legend(row[-1] for row in rows if pair)
    if same := [f"{line.what} {line.values[0]}" for line in lines if line.same]:
        put(f"equal in all: {'; '.join(same)}")


def _places(found):
    """Print the quantities that differ somewhere, a row per place; then one line with those that do not."""
    pair, unequal = len(found.tables) == 2, found.unequal()
    rows = [(row.quantity.heading, row.place.words, *row.texts, *[row.change] * pair)
            for row in found.rows if row.name in unequal]
    if rows:
        heads = ("quantity", "at", *found.names, *["change"] * pair)
        list_table("differences between the results", heads, _without_repeats(rows), whole=True)
    _legend(row[-1] for row in rows if pair)
    for name, places in found.without_result().items():
        put(f"no result in {name}: {', '.join(places)}")
    common = found.common_places()
    if not common:
        put("no place in common: each result has its own")
    if same := [quantity.label for name, quantity in found.quantities.items() if name not in unequal]:
        where = "in all" if common == len(found.places) else f"at the {number_of(common, 'common place')}"
        put(f"equal {where}: {'; '.join(same)}")


def _without_repeats(rows):
    """Rows whose repeated first word is left out."""
    return [(row[0] if n == 0 or rows[n - 1][0] != row[0] else "", *row[1:]) for n, row in enumerate(rows)]


def _legend(changes):
    """Print the meaning of two words of the table."""
    from tehl_taichi.runs.compare_change import NOT_SEPARATED

    if NOT_SEPARATED in changes:
        put(f"{NOT_SEPARATED}: the error bars overlap")


def _with_unit(key):
    """A key with its SI unit."""
    from tehl_taichi.runs.sweep.plan import unit
    from tehl_taichi.scene import scene

    found = "" if key == "contact.load" else unit(scene("gear"), key)  # N or N/m, by the contact.kind
    return f"{key}, {found}" if found not in ("", "1") else key


def _shown(value):
    text = "-" if value is None else f"{value:.5g}" if isinstance(value, float) else " ".join(str(value).split())
    return text if len(text) <= LONG else f"{text[:LONG]} ..."
