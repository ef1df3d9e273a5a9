"""tehl bearing, tehl roller: loads and contacts of a rolling bearing from catalogue or drawing data."""

from typing import Optional

import typer
from tehl_cli.amount import number
from tehl_cli.bearing_features import feature_of
from tehl_cli.bearing_options import DIMENSIONS, SCANNED, contacts, loads
from tehl_cli.idle_options import say_idle, say_no_figure
from tehl_cli.live_display import Live, say
from tehl_cli.missing_results import refuse_missing
from tehl_cli.scene_options import changes_of
from tehl_cli.shared_options import sharing
from tehl_cli.stdout import print_json, put
from tehl_cli.tables import list_table, warning_lines

import tehl_taichi as tehl


@sharing(2, loads, contacts)
def bearing(
    which: str = typer.Argument(..., metavar="designation", help="designation (6206), a TOML file, or any name with own "
                                                                 "dimensions"),
    context: typer.Context = None,
    ball_diameter: Optional[float] = number("diameter of a ball, m"),
    balls: Optional[int] = typer.Option(None, help="number of balls"),
    osculation: Optional[float] = typer.Option(None, help="groove radius over ball diameter, inner ring (default: 0.52)"),
    osculation_outer: Optional[float] = typer.Option(None, help="groove radius over ball diameter, outer ring (default: 0.53)"),
    **shared,
):
    """Compute a rolling bearing: load of every ball, contacts with both rings, slip, film, friction, static safety.

    Examples: `tehl bearing 6206 --load 5000 --speed 3000 --oil mineral-vg100 --temperature 70` · `tehl bearing mine
    --ball-diameter 12e-3 --balls 9 --pitch-diameter 60e-3 --load 6000` · `tehl bearing 6206 --dent 10e-6,0.3e-3,rim=1.2e-6`
    """
    element = None if ball_diameter is balls is None else "ball"
    own = {"element": element, "diameter": ball_diameter, "count": balls, "osculation_inner": osculation,
           "osculation_outer": osculation_outer}
    _compute(which, context, own, **shared)


@sharing(2, loads, contacts)
def roller(
    which: str = typer.Argument("rollers", metavar="designation", help="designation (209-roller), a TOML file, or any name "
                                                                       "with own dimensions"),
    context: typer.Context = None,
    roller_diameter: Optional[float] = number("diameter of a roller at half its length, m"),
    rollers: Optional[int] = typer.Option(None, help="number of rollers"),
    length: Optional[float] = number("effective length of a roller, m"),
    crown: Optional[float] = number("radius of the profile of a crowned roller, m (default: straight)"),
    taper: Optional[float] = number("full cone angle of a tapered roller, degrees (default: cylindrical)"),
    **shared,
):
    """Compute a roller bearing, cylindrical or tapered; the output says whether crowned rollers touch along a line or in a
    slender ellipse.

    Examples: `tehl roller 209-roller --load 4450 --speed 3000` · `tehl roller --roller-diameter 8e-3 --rollers 18
    --pitch-diameter 60e-3 --length 10e-3 --crown 2.5 --contact-angle 15 --taper 4 --load 6000`
    """
    own = {"element": "roller", "diameter": roller_diameter, "count": rollers, "length": length, "crown": crown, "taper": taper}
    _compute(which, context, own, **shared)


def _compute(which, context, own, scene, figure, as_json, quiet, curves, format, dpi, figure_width, **shared):
    """Run the bearing, draw and print it."""
    from tehl_taichi.runs.bearing.ring_contacts import RINGS
    from tehl_taichi.values.checks import choice
    from tehl_taichi.view.figures import folder_figure
    from tehl_taichi.view.figures.figure_style import FigureStyle

    choice("--on", shared["on"], RINGS)
    feature = feature_of(*map(shared.pop, SCANNED))
    page = FigureStyle(format, dpi, figure_width, force=True)
    folder_figure.check(shared["out"], page, "bearing") if figure else say_no_figure(context, "--no-figure draws none")
    if feature is None and scene is None:
        say_idle(context, "nothing passes without --dent, --scan or --scene", "on", "steady")
    if not shared["run"]:
        say_idle(context, "--no-run computes no contact", "workers", "threads")
    with Live(quiet, curves) as live:
        found = _compute_bearing(which, own, live, feature=feature, scene=scene, **shared)
    if figure:
        say(str(found.plot(**vars(page))))
    print_json(found.to_dict()) if as_json else print_bearing(found)
    refuse_missing(found.failed, 2, "contact", found.folder, "the other is")


def _compute_bearing(which, own, live, oil, temperature, thermal, grid, set_, out, **shared):
    """Compute the bearing that the options describe."""
    dimensions = {**own, **{key: shared.pop(key) for key in DIMENSIONS}}
    changes = changes_of({"oil.name": oil, "temperature": temperature, "thermal.on": thermal}, grid, set_ or [])
    return tehl.bearing(which, dimensions=dimensions, changes=changes, folder=out, progress=live, **shared)


def print_bearing(found):
    """Print the tables of a bearing, its answer, its assumptions, and the paths of its scenes."""
    from tehl_taichi.report import bearing_page
    from tehl_taichi.runs.bearing import bearing_table

    put(found.title)
    list_table("bearing", ("quantity", "value"), bearing_table.facts(found), whole=True)
    heads, rows = bearing_table.elements(found)
    list_table("elements", heads, rows, whole=True)
    for title, rows in bearing_table.tables(found).items():
        list_table(title, ("quantity", "inner ring", "outer ring"), rows, whole=True)
    answer = bearing_page.answer(found)
    for sentence in (f"{answer.question} {answer.headline}", *answer.sentences, *bearing_page.limits(found)):
        put(sentence)
    put(f"dimensions: {found.record['source']}")
    for sentence in filter(None, (bearing_table.estimated_words(found), f"assumed: {'; '.join(found.record['assumptions'])}")):
        put(sentence)
    for ring, reason in found.failed.items():
        put(f"no result: {ring} ring: {reason}")
    warning_lines(bearing_table.warnings(found))
    put(f"scenes to run and change: {found.rings['inner']['scene_file']}, {found.rings['outer']['scene_file']}")
    put(f"stores, bearing.csv, bearing.json: {found.folder}")
