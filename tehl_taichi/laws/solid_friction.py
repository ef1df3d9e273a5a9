"""Solid contact: where the film falls to its floor, the surfaces touch with friction."""

from tehl_taichi.engine.pointwise import minimum, pointwise
from tehl_taichi.laws.law import Law
from tehl_taichi.laws.shear import GAMMA, TAU_L0, shear_limit
from tehl_taichi.values.quantity import quantity
from tehl_taichi.values.registry import Checked


@pointwise
def boundary_stress(rheology, p):
    """Friction stress (Pa) of touching surfaces: mu_boundary p, at most the shear limit."""
    return minimum(rheology.mu_boundary * p, shear_limit(rheology, p))


BOUNDARY = Law(
    name="boundary friction", says="Pa: mu_boundary p, at most tau_L0 + gamma p", source="Everitt 2018",
    numbers={"tau_L0": TAU_L0, "gamma": GAMMA,
             "mu_boundary": quantity(0.3, "", "friction coefficient where the surfaces touch", 0.0, 2.0),
             "film_floor": quantity(5e-6, "a^2/R'", "film at which the surfaces touch", 1e-9, 0.1)},
    checked=(Checked("by hand: 0.3 * 20 MPa", 6e6, lambda: boundary_stress(BOUNDARY.having(), 20e6)),
             Checked("by hand: 10 + 0.075 * 1000 MPa, less than 0.3 * 1000", 85e6,
                     lambda: boundary_stress(BOUNDARY.having(), 1e9))))
