"""Pictures of a run and of what is found from it: figures for papers, animations; `palette` is everybody's colours.

`page` is format, size and style, `moments` what is shown of a run; `run_figures` writes `surface_figure`, `line_figures`,
`field_maps` and `fatigue_figures`; `animation` strings `frames` together. May import every room but `study`, `flank` and the
commands. Drawing libraries (the `plot` extra) are imported where a picture is made: `palette` and the checks of `page` work
without.
"""

from tehl_taichi.figures.animation import animate

__all__ = ["animate"]
