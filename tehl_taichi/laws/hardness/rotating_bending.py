"""Fatigue limit of smooth specimens in rotating bending."""

from tehl_taichi.laws.hardness.relation import HardnessRelation
from tehl_taichi.values.registry import Checked

SLOPE = 1.6e6  # Pa per HV


def bending(HV, inclusion=0.0, inside=False):
    """Limit proportional to the hardness, Pa."""
    return SLOPE * HV


ROTATING_BENDING = HardnessRelation(
    name="rotating-bending", says="reversed bending limit = 1.6 HV MPa; above 400 HV an upper bound, as inclusions lower it",
    source="Murakami, Metal Fatigue 2002; Oguma & Nakamura, ICF12 2009: holds for surface failures at 543 and 640 HV",
    spread="6 % up to 400 HV (1.6 ± 0.1)", low=120.0, high=640.0, bending=bending,
    checked=(Checked("by hand: 640 MPa at 400 HV", 640e6, lambda: bending(400.0)),))
