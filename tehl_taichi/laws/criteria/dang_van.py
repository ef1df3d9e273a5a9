"""Dang Van's criterion."""

from tehl_taichi.laws.criteria.criterion import Criterion
from tehl_taichi.values.registry import Checked


def value(tau, normal, mean, kappa):
    """Distance from the circle's centre + kappa (mean stress of that moment)."""
    return tau + kappa * mean


def constants(ratio):
    """kappa and limit, from f = b/2 + kappa b/3 in bending and t in torsion."""
    return 3 * ratio - 1.5, 1.0


DANG_VAN = Criterion(
    name="dang-van", says="shear from the middle of its path + kappa * mean stress, at the moment of the largest sum",
    source="Dang Van, Griveau & Message 1989", value=value, momentary=True, sensitivity="mean stress", constants=constants,
    checked=(Checked("by hand, bending: S/2 + kappa S/3", 60.0, lambda: DANG_VAN.in_bending(100.0, 0.3)),
             Checked("by hand, torsion: S", 100.0, lambda: DANG_VAN.in_torsion(100.0, 0.3))))
