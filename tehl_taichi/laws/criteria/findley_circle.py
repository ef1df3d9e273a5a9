"""Findley's criterion."""

import math

from tehl_taichi.laws.criteria.criterion import Criterion
from tehl_taichi.values.registry import Checked


def value(tau, normal, mean, kappa):
    """tau_amp + kappa sigma_n,max."""
    return tau + kappa * normal


def constants(ratio):
    """kappa and limit, from f = (b/2)(kappa + sqrt(1 + kappa^2)) in bending and t sqrt(1 + kappa^2) in torsion."""
    excess = 2 * ratio - 1
    kappa = excess / math.sqrt(1 - excess**2)
    return kappa, math.sqrt(1 + kappa**2)


FINDLEY = Criterion(
    name="findley", says="shear amplitude + kappa * largest normal stress, on the plane of the largest sum",
    source="Findley 1959", value=value, convex=True, sensitivity="normal stress", constants=constants,
    checked=(Checked("by hand, bending: (S/2)(kappa + sqrt(1 + kappa^2))", 100.0, lambda: FINDLEY.in_bending(100.0, 0.75),
                     1e-8),
             Checked("by hand, torsion: S sqrt(1 + kappa^2)", 125.0, lambda: FINDLEY.in_torsion(100.0, 0.75), 1e-8),
             Checked("by hand: limits of 1 and 0.8 give kappa = 0.75", 0.75, lambda: constants(0.8)[0])))
