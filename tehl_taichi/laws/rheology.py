"""Shear stress of the film by the law of the scene, all in Pa."""

from tehl_taichi.engine.pointwise import absolute, maximum, minimum, pointwise, unrolled, where
from tehl_taichi.laws import shear
from tehl_taichi.laws.law import ShearLaw
from tehl_taichi.values.registry import collect

LAWS = collect(shear, ShearLaw)  # choices of rheology.law
LARGEST = 1e100  # Pa: beyond any trial state, and its square is still a number
DP = 1e3  # Pa, step of the difference quotients of laws: their scale is 1e8 Pa, so a quotient is good to 1e-5


@unrolled
def shear_stress(rheology, newtonian, p):
    """Stress of a film for a given Newtonian stress eta * (shear rate)."""
    return LAWS[rheology.law].stress(rheology, newtonian, p)


@pointwise
def secant(rheology, newtonian, p):
    """Factor of shear thinning, shear_stress / newtonian: 1 without shear."""
    small = absolute(newtonian) < 1e-3
    safe = where(small, newtonian + 1.0, minimum(maximum(newtonian, -LARGEST), LARGEST))
    return where(small, 0.0 * newtonian + 1.0, shear_stress(rheology, safe, p) / safe)
