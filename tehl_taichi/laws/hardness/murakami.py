"""Murakami's fatigue limit of steels with inclusions."""

from tehl_taichi.laws.hardness import rotating_bending
from tehl_taichi.laws.hardness.relation import HardnessRelation
from tehl_taichi.values.registry import Checked

SURFACE, INSIDE = 1.43e6, 1.56e6  # of an inclusion that cuts the surface, and of one inside


def bending(HV, inclusion, inside):
    """Limit of a smooth specimen, or the smaller limit by an inclusion (root of its area, m)."""
    of_inclusion = (INSIDE if inside else SURFACE) * (HV + 120) / (inclusion * 1e6) ** (1 / 6)
    return min(rotating_bending.bending(HV), of_inclusion)


MURAKAMI = HardnessRelation(
    name="murakami", says="reversed bending limit = C (HV + 120)/(sqrt(area) in um)^(1/6) MPa, C = 1.43 at the surface, 1.56 "
                          "inside, at most 1.6 HV; needs fatigue.inclusion",
    source="Murakami, Metal Fatigue 2002, as later papers quote it", spread="not confirmed; often given as 10 to 15 %",
    low=120.0, high=720.0, bending=bending, inclusion=True,
    checked=(Checked("by hand, 380 HV and 64 um inside: 1.56 * 500/2", 390e6, lambda: bending(380.0, 64e-6, True)),
             Checked("by hand, at the surface: 1.43 * 500/2", 357.5e6, lambda: bending(380.0, 64e-6, False)),
             Checked("by hand: no more than 1.6 HV", 160e6, lambda: bending(100.0, 1e-6, True))))
