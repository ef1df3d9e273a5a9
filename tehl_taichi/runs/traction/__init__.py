"""Traction curves: friction, film and temperature of a steady contact over slip, speed and inlet temperature.

`traction_run` plans the cases as a sweep and runs them, `traction_rows` holds the results with error bars, `traction_figure`
draws them.
"""

from tehl_taichi.runs.traction.traction_rows import Traction
from tehl_taichi.runs.traction.traction_run import traction

__all__ = ["Traction", "traction"]
