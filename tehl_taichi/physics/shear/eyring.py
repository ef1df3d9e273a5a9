"""Eyring's stress."""

from math import sinh

from tehl_taichi.engine.pointwise import absolute, exp, log, maximum, minimum, pointwise, sqrt, where
from tehl_taichi.physics.law import ShearLaw
from tehl_taichi.physics.shear import TAU_0
from tehl_taichi.registry import Checked


@pointwise
def stress(rheology, newtonian, p):
    """tau_0 asinh(newtonian/tau_0)."""
    r = absolute(newtonian) / rheology.tau_0
    sign = where(newtonian < 0, -1.0, 1.0)
    return sign * rheology.tau_0 * log(r + sqrt(r * r + 1))


# walls over tau_0: below the first, two terms of the series are good to 2e-8; beyond the second it stays, no film comes near
SMALL, LARGEST = 0.05, 40.0


@pointwise
def poiseuille(rheology, wall, p):
    """3 (S cosh S - sinh S)/S^3, S = wall/tau_0 (Conry, Wang & Cusano 1987, without slip)."""
    S = minimum(wall / rheology.tau_0, LARGEST)
    s = maximum(S, SMALL)
    up, down = exp(s), exp(-s)
    return where(S < SMALL, 1.0 + 0.1 * S * S, 1.5 * (s * (up + down) - (up - down)) / (s * s * s))


EYRING = ShearLaw(
    name="eyring", says="tau_0 asinh(eta * (shear rate)/tau_0)", source="Eyring 1936", numbers={"tau_0": TAU_0}, stress=stress,
    poiseuille=poiseuille, power=LARGEST,
    checked=(Checked("3/S times the integral of s sinh(S s) from 0 to 1, summed at two million places, S = 4", 3.841078788137,
                     lambda: poiseuille(EYRING.having(tau_0=5e6), 20e6, 0.0)),
             Checked("its inverse, eta * (shear rate) = tau_0 sinh(tau/tau_0)", -20e6,
                     lambda: stress(EYRING.having(tau_0=5e6), 5e6 * sinh(-20 / 5), 0.0)),))
