"""A limiting shear stress."""

from tehl_taichi.engine.pointwise import pointwise, sqrt
from tehl_taichi.physics.law import ShearLaw
from tehl_taichi.physics.shear import GAMMA, TAU_L0, shear_limit
from tehl_taichi.registry import Checked


@pointwise
def stress(rheology, newtonian, p):
    """shear rate = (tau/eta) (1 - (tau/tau_L)^2)^(-1/2), solved for tau."""
    r = newtonian / shear_limit(rheology, p)
    return newtonian / sqrt(1 + r * r)


LIMITING = ShearLaw(
    name="limiting", says="smooth towards tau_L = tau_L0 + gamma p: shear rate = (tau/eta) (1 - (tau/tau_L)^2)^(-1/2)",
    source="Lee & Hamrock 1990 (circular model); numbers: Everitt 2018", stress=stress,
    numbers={"tau_L0": TAU_L0, "gamma": GAMMA},
    checked=(Checked("by hand: tau_L = 10 + 0.075 * 1000 = 85 MPa; 0.6 of it takes 51/0.8 MPa of a Newtonian oil", 51e6,
                     lambda: stress(LIMITING.having(), 51e6 / 0.8, 1e9)),))
