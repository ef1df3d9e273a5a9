"""A gear flank: mesh positions with radii, speeds and load, a run at each of them.

`mesh` and `positions` are the geometry, `load_table` loads from elsewhere, `flank_source` reads what names a flank.
`line_contacts` makes the scenes, `outcomes` runs them, `flank_run` is the whole, `stored_flank` its folder, with table and
figure.
"""

from tehl_taichi.runs.flank.flank_run import flank
from tehl_taichi.runs.flank.stored_flank import Flank
from tehl_taichi.scene.gear_pair import PAIRS, GearPair

__all__ = ["PAIRS", "Flank", "GearPair", "flank"]
