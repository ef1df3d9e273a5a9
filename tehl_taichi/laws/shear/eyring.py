"""Eyring's stress."""

from math import sinh

from tehl_taichi.engine.pointwise import absolute, exp, log, maximum, minimum, pointwise, sqrt, where
from tehl_taichi.laws.law import ShearLaw
from tehl_taichi.laws.shear import TAU_0
from tehl_taichi.values.registry import Checked


@pointwise
def stress(rheology, newtonian, p):
    """tau_0 asinh(newtonian/tau_0)."""
    r = absolute(newtonian) / rheology.tau_0
    sign = where(newtonian < 0, -1.0, 1.0)
    return sign * rheology.tau_0 * log(r + sqrt(r * r + 1))


# walls over tau_0: below the first, series are good to 1e-12; beyond the second nothing changes, no film comes near
SMALL, LARGEST = 0.05, 40.0


@pointwise
def shapes(rheology, wall):
    """Functions of S = wall/tau_0: flow without sliding 3 (S cosh S - sinh S)/S^3; its derivative by ln S; S/sinh S; S
    coth S.
    """
    S = minimum(wall / rheology.tau_0, LARGEST)
    s, S2 = maximum(S, SMALL), S * S
    up, down = exp(s), exp(-s)
    sinh, cosh = 0.5 * (up - down), 0.5 * (up + down)
    alone = where(S < SMALL, 1.0 + S2 * (1 / 10 + S2 * (1 / 280 + S2 / 15120)), 3.0 * (s * cosh - sinh) / (s * s * s))
    rise = where(S < SMALL, S2 * (1 / 5 + S2 * (1 / 70 + S2 / 2520)), 3.0 * sinh / s - 3.0 * alone)
    over = where(S < SMALL, 1.0 - S2 * (1 / 6 - S2 * (7 / 360 - S2 * (31 / 15120))), s / sinh)
    coth = where(S < SMALL, 1.0 + S2 * (1 / 3 - S2 * (1 / 45 - S2 * (2 / 945))), s * cosh / sinh)
    inside = where(S < LARGEST, 1.0, 0.0)
    return alone, inside * rise, over, 1.0 + inside * (coth - 1.0)


@pointwise
def flow(rheology, wall, newtonian, p):
    """Flow by Conry, Wang & Cusano 1987: sqrt(1 + x^2) times the flow without sliding, x = (S/sinh S) newtonian/tau_0 =
    sinh(mean stress/tau_0), minus the excess of the latter over Newton's.
    """
    alone, rise, over, coth = shapes(rheology, wall)
    x = over * newtonian / rheology.tau_0
    x2 = x * x
    root = sqrt(1.0 + x2)
    more, by_x = x2 / (1.0 + root), alone * x2 / root
    return 1.0 + alone * more, rise * more + by_x * (1.0 - coth), by_x, 0.0 * wall


@pointwise
def beyond(rheology, wall, newtonian, p):
    """Excess of the flow without sliding over that of Newton."""
    alone, rise, over, coth = shapes(rheology, wall)
    return alone - 1.0, rise, 0.0 * wall, 0.0 * wall


@pointwise
def mean_stress(rheology, wall, newtonian, p):
    return stress(rheology, shapes(rheology, wall)[2] * newtonian, p)


EYRING = ShearLaw(
    name="eyring", says="tau_0 asinh(eta * (shear rate)/tau_0)", source="Eyring 1936", numbers={"tau_0": TAU_0}, stress=stress,
    flow=flow, beyond=beyond, power=LARGEST, mean_stress=mean_stress,
    checked=(Checked("3/S times the integral of s sinh(S s) from 0 to 1, summed at two million places, S = 4", 3.841078788137,
                     lambda: 1.0 + beyond(EYRING.having(tau_0=5e6), 20e6, 0.0, 0.0)[0]),
             Checked("its inverse, eta * (shear rate) = tau_0 sinh(tau/tau_0)", -20e6,
                     lambda: stress(EYRING.having(tau_0=5e6), 5e6 * sinh(-20 / 5), 0.0)),))
