"""Figures of a run: for papers, for reports, as animations.

`figure_style` is format, size and style, `palette` the colours, `moments` the drawn moments of a run. `run_figures` writes
`surface_figure`, `line_figures`, `field_maps` and `fatigue_figures`; `animation` joins `frames`.
"""

from tehl_taichi.view.figures.animation import animate

__all__ = ["animate"]
