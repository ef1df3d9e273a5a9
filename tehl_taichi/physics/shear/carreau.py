"""Carreau's power law."""

from math import sqrt

from tehl_taichi.engine.pointwise import exp, log, pointwise
from tehl_taichi.physics.law import ShearLaw
from tehl_taichi.physics.shear import TAU_0
from tehl_taichi.registry import Checked
from tehl_taichi.values.quantity import quantity

TINY = 1e-12  # for n = 1, where c is 1


@pointwise
def stress(rheology, newtonian, p):
    """newtonian (1 + (newtonian/tau_0)^2)^((n - 1)/2)."""
    r = newtonian / rheology.tau_0
    return newtonian * exp(0.5 * (rheology.carreau_n - 1) * log(1 + r * r))


@pointwise
def poiseuille(rheology, wall, p):
    """(1 + (c wall/tau_0)^2)^((1/n - 1)/2) with c for which it is that of the power law, 3n/(2n + 1) (wall/tau_0)^(1/n - 1),
    far beyond tau_0; between it is within 3 % of the integral across the film for n = 0.6 and more, 40 % for 0.3."""
    n = rheology.carreau_n
    c = exp(log(3 * n / (2 * n + 1)) * n / (1.0 - n + TINY))
    r = c * wall / rheology.tau_0
    return exp(0.5 * (1 / n - 1) * log(1 + r * r))


CARREAU = ShearLaw(
    name="carreau", says="s (1 + (s/tau_0)^2)^((carreau_n - 1)/2), s = eta * (shear rate)",
    source="Carreau 1972", stress=stress,
    poiseuille=poiseuille,
    numbers={"tau_0": TAU_0, "carreau_n": quantity(0.8, "", "exponent (1: newtonian)", 0.1, 1.0)},
    checked=(Checked("the integral across the film, summed at 20 000 places: 1.24 times as much at 3 tau_0, n = 0.8", 1.240,
                     lambda: poiseuille(CARREAU.having(), 30e6, 1e9), 5e-3),
             Checked("by hand: (s/tau_0)^2 = 3 and n = 0.6 leave 2^-0.4", sqrt(3) * 6e6 * 2**-0.4,
                     lambda: stress(CARREAU.having(tau_0=6e6, carreau_n=0.6), sqrt(3) * 6e6, 1e9)),))
