"""The options that every command has that draws."""

from typing import Annotated

import typer

Format = Annotated[str, typer.Option("--format", help="of the figures: png, pdf or svg")]
Dpi = Annotated[int, typer.Option("--dpi", help="dots per inch, of the maps in pdf and svg too, 40 to 1200")]
Force = Annotated[bool, typer.Option("--force", help="replace files that are there, if tehl wrote them")]
_WIDE = "of the figures, cm, 5 to 60: a journal's column is 8.5, two are 17"
Width = Annotated[float, typer.Option("--width", help=_WIDE)]
FigureWidth = Annotated[float, typer.Option("--figure-width", help=_WIDE)]  # where --width is that of a feature
