"""Matake's criterion."""

from tehl_taichi.laws.criteria.criterion import Criterion
from tehl_taichi.laws.criteria.findley_circle import value
from tehl_taichi.values.registry import Checked


def constants(ratio):
    """kappa and limit, from f = (1 + kappa) b/2 in bending and t in torsion."""
    return 2 * ratio - 1, 1.0


MATAKE = Criterion(
    name="matake", says="Findley's sum on the plane of the largest shear amplitude (of equal planes the one with the largest "
                        "normal stress)",
    source="Matake 1977", value=value, sheared=True, sensitivity="normal stress",
    constants=constants,
    checked=(Checked("by hand, bending: (1 + kappa) S/2, at 45 degrees", 65.0, lambda: MATAKE.in_bending(100.0, 0.3)),
             Checked("by hand, torsion: S", 100.0, lambda: MATAKE.in_torsion(100.0, 0.3))))
