"""Options with one meaning in several commands; each command has its own default."""

from pathlib import Path
from typing import Annotated, List, Optional

from tehl_cli.amount import also_number
from typer import Option

# of the scene
Oil = Annotated[Optional[str], Option(help="name of the oil (`tehl oils`)")]
Temperature = Annotated[Optional[float], also_number("inlet temperature, deg C")]
Height = Annotated[Optional[float], also_number("feature height, m (negative: dent)")]
FeatureWidth = Annotated[Optional[float], also_number("feature width, m")]
Thermal = Annotated[Optional[bool], Option("--thermal/--isothermal", help="with or without the energy equation")]
UsuallyThermal = Annotated[Optional[bool], Option("--thermal/--isothermal", help="with (default) or without energy equation")]
Fatigue = Annotated[Optional[bool], Option("--fatigue/--no-fatigue", help="with or without stresses and fatigue index")]
Kappa = Annotated[Optional[float], Option(help="sensitivity to normal stress kappa_F")]
Endurance = Annotated[Optional[float], also_number("fatigue limit sigma_eF, Pa")]
BendingLimit = Annotated[Optional[float], also_number("fatigue limit in reversed bending, Pa (replaces --endurance)")]
TorsionLimit = Annotated[Optional[float], also_number("fatigue limit in reversed torsion, Pa (one limit fixes sigma_eF; both "
                                                      "limits also fix kappa)")]
Grid = Annotated[Optional[str], Option(help="coarse, medium, fine or NXxNY (cells or nodes; NX alone if nothing varies along "
                                            "y)")]
SetInAll = Annotated[Optional[List[str]], Option("--set", help="dotted.key=value in all cases, repeatable")]

# of gears, bearings and cams
Base = Annotated[Optional[str], Option(help="scene with oil, bodies, features and numerics: built-in name, TOML file or store")]
Smooth = Annotated[bool, Option("--steady", help="steady contacts without the features of --scene")]
Unit = Annotated[Optional[str], Option(help="unit of the heights of --scan, if the file does not state it")]
Pixel = Annotated[Optional[float], also_number("distance of the points of --scan in m, if the file does not state it")]
SetInScenes = Annotated[Optional[List[str]], Option("--set", help="dotted.key=value of the scenes, repeatable")]

# of figures
Format = Annotated[str, Option("--format", help="file format of the figures: png, pdf or svg")]
Dpi = Annotated[int, Option("--dpi", help="resolution in dots per inch (in pdf and svg: of the maps), 40 to 1200")]
Force = Annotated[bool, Option("--force", help="replace existing files that tehl wrote")]
_WIDE = "width of the figures, cm, 5 to 60 (one journal column: 8.5, two: 17)"
Width = Annotated[float, Option("--width", help=_WIDE)]
FigureWidth = Annotated[float, Option("--figure-width", help=_WIDE)]  # where --width is that of a feature
Figures = Annotated[Optional[Path], Option(help="folder for figures")]

# of the command
Workers = Annotated[Optional[int], Option(help="number of processes on this machine (default: one per core)")]
ThreadsPerWorker = Annotated[Optional[int], Option(help="CPU threads per case (default: 1, or the cores that --workers "
                                                        "leaves)")]
ALL_CORES = "CPU threads (default: all)"
Threads = Annotated[Optional[int], Option(help=ALL_CORES)]
DryRun = Annotated[bool, Option("--dry-run", help="print what would run, and stop")]
AsJson = Annotated[bool, Option("--json", help="print one JSON object to stdout and all else to stderr")]
Quiet = Annotated[bool, Option("--quiet", help="print no progress")]
_DRAW = "draw p, h and T along y = 0 in the terminal"
Curves = Annotated[bool, Option("--live/--no-live", help=f"{_DRAW} during the run")]
CurvesOfOne = Annotated[bool, Option("--live/--no-live", help=f"{_DRAW} (with --workers 1)")]
Timing = Annotated[bool, Option("--timing", help="print the time of each part of the command")]
