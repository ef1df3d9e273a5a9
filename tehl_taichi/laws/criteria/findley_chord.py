"""Findley's criterion with the longest chord."""

from tehl_taichi.laws.criteria.criterion import Criterion
from tehl_taichi.laws.criteria.findley_circle import constants, value
from tehl_taichi.values.registry import Checked

CHORD = Criterion(
    name="findley-chord", says="Findley's criterion with half the longest chord of the shear path as amplitude",
    source="Findley 1959, the amplitude as many programs take it", value=value, chord=True, convex=True,
    sensitivity="normal stress", constants=constants,
    checked=(Checked("a straight path has its chord for diameter: as findley", 100.0,
                     lambda: CHORD.in_bending(100.0, 0.75), 1e-8),))
