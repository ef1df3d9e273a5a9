"""tehl bearing, tehl roller: loads and contacts of a rolling bearing from its catalogue or its drawing."""

from pathlib import Path
from typing import List, Optional

import typer
from tehl_cli.bearing_features import feature_of
from tehl_cli.figure_options import Dpi, FigureWidth, Format
from tehl_cli.idle_options import DRAWS, say_idle
from tehl_cli.live_display import Live, say
from tehl_cli.scene_options import given_by
from tehl_cli.stdout import print_json, put


def register(app):
    """Add the commands to the app."""
    app.command()(bearing)
    app.command()(roller)


Load = typer.Option(None, help="radial load, N (default: 1000)")
Axial = typer.Option(None, help="axial load, N (default: 0; with a contact angle the load at which the displacement is radial)")
Speed = typer.Option(None, help="speed of the inner ring, 1/min (default: 1500)")
OuterSpeed = typer.Option(None, help="speed of the outer ring, 1/min (default: 0; negative: against the inner ring)")
Pitch = typer.Option(None, help="pitch diameter: of the circle through the centres of the elements, m")
Angle = typer.Option(None, help="contact angle without load, degrees (tapered rollers: of the outer ring)")
Clearance = typer.Option(None, help="radial clearance in operation, m (default: 0)")
Oil = typer.Option(None, help="name of the oil (`tehl oils`)")
Temperature = typer.Option(None, help="inlet temperature, deg C")
Dent = typer.Option(None, help="dent that passes: DEPTH,WIDTH,rim=HEIGHT in m, as 10e-6,0.3e-3,rim=1.2e-6; rim_width=WIDTH may "
                               "follow")
Scan = typer.Option(None, help="file of measured heights that pass, on a grid or along a line")
Unit = typer.Option(None, help="unit of the heights of --scan, where the file does not state it")
Pixel = typer.Option(None, help="distance of the points of --scan in m, where the file does not state it")
On = typer.Option("inner", help="ring that carries the dent or scan: inner or outer")
Roughness = typer.Option(None, help="rms height of both surfaces together, m, for lambda = h_c/Sq")
SceneFile = typer.Option(None, help="scene with oil, bodies, features and numerics: built-in name, TOML file or store")
Steady = typer.Option(False, "--steady", help="steady contacts without the features of --scene")
Thermal = typer.Option(None, "--thermal/--isothermal", help="with or without the energy equation (default: with it if elements "
                                                            "slip)")
Settings = typer.Option(None, "--set", help="dotted.key=value of the scenes, repeatable")
GridName = typer.Option(None, help="coarse, medium, fine or NXxNY (default: 128x32 for steady contacts)")
Run = typer.Option(True, "--run/--no-run", help="compute both contacts, or print loads, dry contacts and formulas only")
Out = typer.Option(None, help="folder to write (default: runs/NAME-N); existing runs in it are resumed")
Draw = typer.Option(True, "--figure/--no-figure", help="draw bearing.png (.pdf, .svg) in that folder")
Workers = typer.Option(None, help="number of contacts computed at the same time (default: one per core)")
Threads = typer.Option(None, help="CPU threads per contact (default: the cores that --workers leaves, or 1)")
AsJson = typer.Option(False, "--json", help="print one JSON object to stdout and all else to stderr")
Quiet = typer.Option(False, "--quiet", help="print no progress")
Curves = typer.Option(True, "--live/--no-live", help="draw p, h and T along y = 0 in the terminal (with --workers 1)")


def bearing(
    which: str = typer.Argument(..., metavar="DESIGNATION", help="designation (6206), a TOML file, or any name with own "
                                                                 "dimensions"),
    context: typer.Context = None,
    load: Optional[float] = Load, axial: Optional[float] = Axial, speed: Optional[float] = Speed,
    outer_speed: Optional[float] = OuterSpeed,
    ball_diameter: Optional[float] = typer.Option(None, help="diameter of a ball, m"),
    balls: Optional[int] = typer.Option(None, help="number of balls"),
    pitch_diameter: Optional[float] = Pitch,
    osculation: Optional[float] = typer.Option(None, help="groove radius over ball diameter, inner ring (default: 0.52)"),
    osculation_outer: Optional[float] = typer.Option(None, help="groove radius over ball diameter, outer ring (default: 0.53)"),
    contact_angle: Optional[float] = Angle, clearance: Optional[float] = Clearance,
    oil: Optional[str] = Oil, temperature: Optional[float] = Temperature, dent: Optional[str] = Dent,
    scan: Optional[Path] = Scan, unit: Optional[str] = Unit, pixel: Optional[float] = Pixel, on: str = On,
    roughness: Optional[float] = Roughness, scene: Optional[str] = SceneFile, steady: bool = Steady,
    thermal: Optional[bool] = Thermal, set_: Optional[List[str]] = Settings, grid: Optional[str] = GridName, run: bool = Run,
    out: Optional[Path] = Out, figure: bool = Draw, format: Format = "png", dpi: Dpi = 160, figure_width: FigureWidth = 17.0,
    workers: Optional[int] = Workers, threads: Optional[int] = Threads, as_json: bool = AsJson, quiet: bool = Quiet,
    curves: bool = Curves,
):
    """Compute a rolling bearing: load of every ball, contacts with both rings, slip, film, friction, static safety.

    Examples: `tehl bearing 6206 --load 5000 --speed 3000 --oil mineral-vg100 --temperature 70` · `tehl bearing mine
    --ball-diameter 12e-3 --balls 9 --pitch-diameter 60e-3 --load 6000` · `tehl bearing 6206 --dent 10e-6,0.3e-3,rim=1.2e-6`
    """
    own = {"diameter": ball_diameter, "count": balls, "pitch_diameter": pitch_diameter, "osculation_inner": osculation,
           "osculation_outer": osculation_outer, "contact_angle": contact_angle, "clearance": clearance,
           "outer_speed": outer_speed}
    _compute(**{**locals(), "own": own, "feature": feature_of(dent, scan, unit, pixel)})


def roller(
    which: str = typer.Argument("rollers", metavar="[DESIGNATION]", help="designation (209-roller), a TOML file, or any name "
                                                                         "with own dimensions"),
    context: typer.Context = None,
    load: Optional[float] = Load, axial: Optional[float] = Axial, speed: Optional[float] = Speed,
    outer_speed: Optional[float] = OuterSpeed,
    roller_diameter: Optional[float] = typer.Option(None, help="diameter of a roller at half its length, m"),
    rollers: Optional[int] = typer.Option(None, help="number of rollers"),
    pitch_diameter: Optional[float] = Pitch,
    length: Optional[float] = typer.Option(None, help="effective length of a roller, m"),
    crown: Optional[float] = typer.Option(None, help="radius of the profile of a crowned roller, m (default: straight)"),
    taper: Optional[float] = typer.Option(None, help="full cone angle of a tapered roller, degrees (default: cylindrical)"),
    contact_angle: Optional[float] = Angle, clearance: Optional[float] = Clearance,
    oil: Optional[str] = Oil, temperature: Optional[float] = Temperature, dent: Optional[str] = Dent,
    scan: Optional[Path] = Scan, unit: Optional[str] = Unit, pixel: Optional[float] = Pixel, on: str = On,
    roughness: Optional[float] = Roughness, scene: Optional[str] = SceneFile, steady: bool = Steady,
    thermal: Optional[bool] = Thermal, set_: Optional[List[str]] = Settings, grid: Optional[str] = GridName, run: bool = Run,
    out: Optional[Path] = Out, figure: bool = Draw, format: Format = "png", dpi: Dpi = 160, figure_width: FigureWidth = 17.0,
    workers: Optional[int] = Workers, threads: Optional[int] = Threads, as_json: bool = AsJson, quiet: bool = Quiet,
    curves: bool = Curves,
):
    """Compute a roller bearing, cylindrical or tapered; the output says whether crowned rollers touch along a line or in a
    slender ellipse.

    Examples: `tehl roller 209-roller --load 4450 --speed 3000` · `tehl roller --roller-diameter 8e-3 --rollers 18
    --pitch-diameter 60e-3 --length 10e-3 --crown 2.5 --contact-angle 15 --taper 4 --load 6000`
    """
    own = {"element": None if which.lower().endswith((".toml", "-roller")) else "roller", "diameter": roller_diameter,
           "count": rollers, "pitch_diameter": pitch_diameter, "length": length, "crown": crown, "taper": taper,
           "contact_angle": contact_angle, "clearance": clearance, "outer_speed": outer_speed}
    _compute(**{**locals(), "own": own, "feature": feature_of(dent, scan, unit, pixel)})


def _compute(which, context, own, feature, oil, temperature, thermal, grid, set_, format, dpi, figure_width, figure, out, run,
             quiet, curves, as_json, load, axial, speed, on, roughness, scene, steady, workers, threads, **_):
    """Run the bearing and print it."""
    import tehl_taichi as tehl
    from tehl_taichi.view.figures import folder_figure
    from tehl_taichi.view.figures.figure_style import FigureStyle

    page = FigureStyle(format, dpi, figure_width, force=True)
    folder_figure.check(out, page, "bearing") if figure else say_idle(context, "--no-figure draws none", *DRAWS)
    if feature is None and scene is None:
        say_idle(context, "nothing passes without --dent, --scan or --scene", "on", "steady")
    changes = given_by({"oil.name": oil, "temperature": temperature, "thermal.on": thermal}, grid, set_ or [])
    with Live(quiet, curves) as live:
        found = tehl.bearing(which, load=load, axial=axial, speed=speed, dimensions=own, on=on, feature=feature,
                             roughness=roughness, scene=scene, changes=changes, steady=steady, run=run, folder=out,
                             workers=workers, threads=threads, progress=live)
    if figure:
        say(str(found.plot(**vars(page))))
    print_json(found.to_dict()) if as_json else print_bearing(found)
    if found.failed:
        from tehl_taichi.errors import NotConverged

        raise NotConverged(f"{len(found.failed)} of 2 contacts have no result; the other is in {found.folder}. Try another "
                           "--grid or --set with a new --out")


def print_bearing(found):
    """Print the tables of a bearing, what was assumed, and where its scenes are."""
    from tehl_cli.tables import list_table, warning_lines

    from tehl_taichi.runs.bearing import bearing_table

    put(found.title)
    list_table("bearing", ("quantity", "value"), bearing_table.facts(found), whole=True)
    heads, rows = bearing_table.elements(found)
    list_table("elements", heads, rows, whole=True)
    for title, rows in bearing_table.tables(found).items():
        list_table(title, ("quantity", "inner ring", "outer ring"), rows, whole=True)
    put(f"dimensions: {found.record['source']}")
    for sentence in filter(None, (bearing_table.estimated_words(found), f"assumed: {'; '.join(found.record['assumptions'])}")):
        put(sentence)
    for ring, reason in found.failed.items():
        put(f"no result: {ring} ring: {reason}")
    warning_lines(bearing_table.warnings(found))
    put(f"scenes to run and change: {found.rings['inner']['scene_file']}, {found.rings['outer']['scene_file']}")
    put(f"stores, bearing.csv, bearing.json: {found.folder}")
