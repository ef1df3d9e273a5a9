"""A limiting shear stress."""

from tehl_taichi.engine.pointwise import minimum, pointwise, sqrt
from tehl_taichi.physics.law import ShearLaw
from tehl_taichi.physics.shear import GAMMA, TAU_L0, shear_limit
from tehl_taichi.registry import Checked


@pointwise
def stress(rheology, newtonian, p):
    """shear rate = (tau/eta) (1 - (tau/tau_L)^2)^(-1/2), solved for tau."""
    r = newtonian / shear_limit(rheology, p)
    return newtonian / sqrt(1 + r * r)


MOST = 2.0  # times tau_L: no film comes near it, trial states do


@pointwise
def poiseuille(rheology, wall, p):
    """1 + (wall/tau_L)^40: no wall holds more than tau_L, beyond it the oil slips along both.

    So |grad p| <= 2 tau_L/h (Ståhl & Jacobson 2003), which frozen oil exceeds by a tenth: so sharply limits of shear set in
    (40: tau_L over the 5 to 10 MPa of Eyring's stress). 100 in its place changes pressures at the exit by 2 %
    (docs/exit.md). Below tau_L the circular law by itself would drive at most 3 pi/4 of the Newtonian flow.
    """
    r = minimum(wall / shear_limit(rheology, p), MOST)
    r2 = r * r
    r4 = r2 * r2
    r8 = r4 * r4
    r16 = r8 * r8
    return 1.0 + r8 * r16 * r16


LIMITING = ShearLaw(
    name="limiting", says="smooth towards tau_L = tau_L0 + gamma p: shear rate = (tau/eta) (1 - (tau/tau_L)^2)^(-1/2)",
    source="Lee & Hamrock 1990 (circular model); numbers: Everitt 2018", stress=stress,
    poiseuille=poiseuille, power=41.0,  # the gradient itself, times its fortieth power
    numbers={"tau_L0": TAU_L0, "gamma": GAMMA},
    checked=(Checked("by hand: 1.5 tau_L = 127.5 MPa on the walls drive 1 + 1.5^40 times as much", 1 + 1.5**40,
                     lambda: poiseuille(LIMITING.having(), 127.5e6, 1e9)),
             Checked("by hand: tau_L = 10 + 0.075 * 1000 = 85 MPa; 0.6 of it takes 51/0.8 MPa of a Newtonian oil", 51e6,
                     lambda: stress(LIMITING.having(), 51e6 / 0.8, 1e9)),))
