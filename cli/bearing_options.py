"""Options that `tehl bearing` and `tehl roller` share."""

from pathlib import Path
from typing import Annotated, Optional

from tehl_cli import usual_options as usual
from tehl_cli.amount import also_number
from typer import Option

DIMENSIONS = ("pitch_diameter", "contact_angle", "clearance", "outer_speed")  # of the bearing
SCANNED = ("dent", "scan", "unit", "pixel")  # of the feature


def loads(
    load: Annotated[Optional[float], also_number("radial load, N (default: 1000)")] = None,
    axial: Annotated[Optional[float], also_number("axial load, N (default: 0; with a contact angle the load at which the "
                                                  "displacement is radial)")] = None,
    speed: Annotated[Optional[float], also_number("speed of the inner ring, 1/min (default: 1500)")] = None,
    outer_speed: Annotated[Optional[float], also_number("speed of the outer ring, 1/min (default: 0; negative: against the "
                                                        "inner ring)")] = None,
):
    """Options for loads and speeds."""


def contacts(
    pitch_diameter: Annotated[Optional[float], also_number("diameter of the pitch circle, through the centres of the elements, "
                                                           "m")] = None,
    contact_angle: Annotated[Optional[float], also_number("contact angle without load, degrees (tapered rollers: of the outer "
                                                          "ring)")] = None,
    clearance: Annotated[Optional[float], also_number("radial clearance in operation, m (default: 0)")] = None,
    oil: usual.Oil = None, temperature: usual.Temperature = None,
    dent: Annotated[Optional[str], Option(help="dent that passes: DEPTH,WIDTH,rim=HEIGHT in m, for example "
                                               "10e-6,0.3e-3,rim=1.2e-6; rim_width=WIDTH may follow")] = None,
    scan: Annotated[Optional[Path], Option(help="file of measured heights that pass, on a grid or along a line")] = None,
    unit: usual.Unit = None, pixel: usual.Pixel = None,
    on: Annotated[str, Option(help="ring that carries the dent or scan: inner or outer")] = "inner",
    roughness: Annotated[Optional[float], also_number("rms height of both surfaces together, m, for lambda = h_c/Sq")] = None,
    scene: usual.Base = None, steady: usual.Smooth = False,
    thermal: Annotated[Optional[bool], Option("--thermal/--isothermal", help="with or without the energy equation (default: "
                                                                             "with it if elements slip)")] = None,
    set_: usual.SetInScenes = None,
    grid: Annotated[Optional[str], Option(help="coarse, medium, fine or NXxNY (default: 128x32 for steady contacts)")] = None,
    run: Annotated[bool, Option("--run/--no-run", help="compute both contacts, or print loads, dry contacts and formulas "
                                                       "only")] = True,
    out: Annotated[Optional[Path], Option(help="folder to write (default: runs/NAME-N); existing runs in it are "
                                                "resumed")] = None,
    figure: Annotated[bool, Option("--figure/--no-figure", help="draw bearing.png (.pdf, .svg) in that folder")] = True,
    format: usual.Format = "png", dpi: usual.Dpi = 160, figure_width: usual.FigureWidth = 17.0,
    workers: Annotated[Optional[int], Option(help="number of contacts computed at the same time (default: one per "
                                                   "core; 1 while a feature passes)")] = None,
    threads: Annotated[Optional[int], Option(help="CPU threads per contact (default: the cores that --workers leaves, or "
                                                  "1)")] = None,
    as_json: usual.AsJson = False, quiet: usual.Quiet = False, curves: usual.CurvesOfOne = True,
):
    """Options for contacts, scenes, results and progress."""
