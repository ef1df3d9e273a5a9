"""A gear's whole flank: where its teeth touch, with which radii, speeds and load, and a run at each position.

`mesh` and `positions` are the geometry, `load_table` the table of a loaded tooth contact analysis, `described` what names a
flank, `contacts` its scenes, `outcomes` runs them; `whole_flank` is all of it, `stored_flank` what its folder keeps, `columns`
and `flank_figure` what is shown. May import every room but the commands; importing it imports no taichi.
"""

from tehl_taichi.flank.stored_flank import Flank
from tehl_taichi.flank.whole_flank import flank
from tehl_taichi.scene.gear_pair import PAIRS, GearPair

__all__ = ["PAIRS", "Flank", "GearPair", "flank"]
