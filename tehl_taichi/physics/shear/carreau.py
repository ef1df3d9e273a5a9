"""Carreau's power law."""

from math import sqrt

from tehl_taichi.engine.pointwise import exp, log, pointwise
from tehl_taichi.physics.law import ShearLaw
from tehl_taichi.physics.shear import TAU_0
from tehl_taichi.registry import Checked
from tehl_taichi.values.quantity import quantity


@pointwise
def stress(rheology, newtonian, p):
    """newtonian (1 + (newtonian/tau_0)^2)^((n - 1)/2)."""
    r = newtonian / rheology.tau_0
    return newtonian * exp(0.5 * (rheology.carreau_n - 1) * log(1 + r * r))


CARREAU = ShearLaw(
    name="carreau", says="s (1 + (s/tau_0)^2)^((carreau_n - 1)/2), s = eta * (shear rate)",
    source="Carreau 1972", stress=stress,
    numbers={"tau_0": TAU_0, "carreau_n": quantity(0.8, "", "exponent (1: newtonian)", 0.1, 1.0)},
    checked=(Checked("by hand: (s/tau_0)^2 = 3 and n = 0.6 leave 2^-0.4", sqrt(3) * 6e6 * 2**-0.4,
                     lambda: stress(CARREAU.having(tau_0=6e6, carreau_n=0.6), sqrt(3) * 6e6, 1e9)),))
