"""A limiting shear stress."""

from tehl_taichi.engine.pointwise import minimum, pointwise, sqrt, where
from tehl_taichi.laws.circular_law import circular_flow, circular_slip, circular_stress
from tehl_taichi.laws.law import ShearLaw
from tehl_taichi.laws.shear import GAMMA, TAU_L0, shear_limit
from tehl_taichi.values.registry import Checked


@pointwise
def stress(rheology, newtonian, p):
    """shear rate = (tau/eta) (1 - (tau/tau_L)^2)^(-1/2), solved for tau."""
    r = newtonian / shear_limit(rheology, p)
    return newtonian / sqrt(1 + r * r)


@pointwise
def flow(rheology, wall, newtonian, p):
    """Flow by the circular law; both stresses are divided by tau_L, which rises with the pressure."""
    limit = shear_limit(rheology, p)
    part, by_wall, by_newtonian = circular_flow(wall / limit, newtonian / limit)
    return part, by_wall, by_newtonian, -(by_wall + by_newtonian) * rheology.gamma / limit


@pointwise
def mean_stress(rheology, wall, newtonian, p):
    limit = shear_limit(rheology, p)
    return limit * circular_stress(wall / limit, newtonian / limit)


@pointwise
def slip(rheology, wall, newtonian, p):
    limit = shear_limit(rheology, p)
    return circular_slip(wall / limit, newtonian / limit)


MOST = 2.0  # times tau_L: no film comes near it, trial states do


@pointwise
def beyond(rheology, wall, newtonian, p):
    """Additional flow (wall/tau_L)^40 relative to sheared oil: no wall carries more than tau_L; beyond it the oil slips along
    both.

    So |grad p| <= 2 tau_L/h (Ståhl & Jacobson 2003); frozen oil exceeds it by a tenth. The exponent describes how sharply shear
    limits set in (40: tau_L over the 5 to 10 MPa of Eyring's stress). An exponent of 100 changes pressures at the exit by 2 %
    (docs/exit.md). The circular law itself does not determine this flow.
    """
    limit = shear_limit(rheology, p)
    s, r = minimum(wall / limit, MOST), newtonian / limit
    r2, k2 = s * s, 1.0 + r * r
    r4 = r2 * r2
    r8 = r4 * r4
    r16 = r8 * r8
    part, rise, steep = sqrt(k2) * r8 * r16 * r16, 1.0 - 1.0 / k2, where(s < MOST, 40.0, 0.0)
    return part, steep * part, rise * part, -(steep + rise) * part * rheology.gamma / limit


LIMITING = ShearLaw(
    name="limiting", says="approaches tau_L = tau_L0 + gamma p smoothly: shear rate = (tau/eta) (1 - (tau/tau_L)^2)^(-1/2)",
    source="Lee & Hamrock 1990 (circular model); numbers: Everitt 2018", stress=stress,
    flow=flow, mean_stress=mean_stress, slip=slip, limit=shear_limit,
    beyond=beyond, power=41.0,  # the gradient itself, times its fortieth power
    numbers={"tau_L0": TAU_L0, "gamma": GAMMA},
    checked=(Checked("by hand: 1.5 tau_L = 127.5 MPa on the walls drive 1.5^40 times as much on top", 1.5**40,
                     lambda: beyond(LIMITING.having(), 127.5e6, 0.0, 1e9)[0]),
             Checked("the integral across the film, summed: walls at 0.3 tau_L, a sliding of 3 tau_L", 21.4682016206,
                     lambda: flow(LIMITING.having(), 25.5e6, 255e6, 1e9)[0], 1e-8),
             Checked("by hand: tau_L = 10 + 0.075 * 1000 = 85 MPa; 0.6 of it takes 51/0.8 MPa of a Newtonian oil", 51e6,
                     lambda: stress(LIMITING.having(), 51e6 / 0.8, 1e9)),))
