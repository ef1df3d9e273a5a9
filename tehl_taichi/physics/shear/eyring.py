"""Eyring's stress."""

from math import sinh

from tehl_taichi.engine.pointwise import absolute, log, pointwise, sqrt, where
from tehl_taichi.physics.law import ShearLaw
from tehl_taichi.physics.shear import TAU_0
from tehl_taichi.registry import Checked


@pointwise
def stress(rheology, newtonian, p):
    """tau_0 asinh(newtonian/tau_0)."""
    r = absolute(newtonian) / rheology.tau_0
    sign = where(newtonian < 0, -1.0, 1.0)
    return sign * rheology.tau_0 * log(r + sqrt(r * r + 1))


EYRING = ShearLaw(
    name="eyring", says="tau_0 asinh(eta * (shear rate)/tau_0)", source="Eyring 1936", numbers={"tau_0": TAU_0}, stress=stress,
    checked=(Checked("its inverse, eta * (shear rate) = tau_0 sinh(tau/tau_0)", -20e6,
                     lambda: stress(EYRING.having(tau_0=5e6), 5e6 * sinh(-20 / 5), 0.0)),))
