"""Gear flanks: mesh positions with radii, speeds and load; one run per position.

`mesh` and `positions` are the geometry, `load_table` reads loads of other programs, `flank_source` finds a flank by its name.
`line_contacts` makes the scenes, `outcomes` runs them, `flank_run` does both, `stored_flank` is the folder, with table and
figure.
"""

from tehl_taichi.runs.flank.flank_run import flank
from tehl_taichi.runs.flank.stored_flank import Flank
from tehl_taichi.scene.gear_pair import PAIRS, GearPair

__all__ = ["PAIRS", "Flank", "GearPair", "flank"]
