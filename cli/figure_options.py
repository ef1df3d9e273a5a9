"""Options of every command that draws."""

from typing import Annotated

import typer

Format = Annotated[str, typer.Option("--format", help="file format of the figures: png, pdf or svg")]
Dpi = Annotated[int, typer.Option("--dpi", help="resolution in dots per inch (in pdf and svg: of the maps), 40 to 1200")]
Force = Annotated[bool, typer.Option("--force", help="replace existing files that tehl wrote")]
_WIDE = "width of the figures, cm, 5 to 60 (one journal column: 8.5, two: 17)"
Width = Annotated[float, typer.Option("--width", help=_WIDE)]
FigureWidth = Annotated[float, typer.Option("--figure-width", help=_WIDE)]  # where --width is that of a feature
