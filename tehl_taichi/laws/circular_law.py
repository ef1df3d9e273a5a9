"""Flow of a film with one viscosity by the circular law, shear rate = (tau/eta) (1 - (tau/tau_L)^2)^(-1/2).

s: wall stress h |grad p|/2 of a pressure gradient along the sliding; r: Newtonian stress eta |u_s|/h of the sliding; both over
tau_L. With tau = tau_L sin(angle) all integrals across the film are closed. Up to s (1 + r^2) = 1 the oil sticks to both walls.
Beyond, it slips along the wall where |tau| = tau_L, and the film has only the sliding at that bound. So all results are
functions of K^2 = min(1 + r^2, 1/s), with a one-sided derivative at the bound.
"""

from tehl_taichi.engine.pointwise import asin, maximum, minimum, pointwise, sqrt, where

SERIES = 0.05
# Up to this r as it is. Beyond, the flow is nearly a switch, all but 1/r of the slip from s = 1/(1 + r^2) on, and Newton steps
# go to and fro: there a gradient drives 0.7 of what slips at s = 1/MOST_R^2, and 99 % of it from 7 times that on. The limit
# without it, and what each bound costs: docs/decisions/01-sheared-flow.md
MOST_R = 15.0
SLIDING, TINY, LEAST_S = 1e-30, 1e-12, 1e-12


@pointwise
def wedge(x):
    """Function 3/2 (d - sin d cos d)/sin^3 d, sin d = x: flow between sticking walls under a gradient alone."""
    y, x2 = maximum(x, SERIES), x * x
    series = 1.0 + x2 * (0.3 + x2 * (9 / 56 + x2 * (5 / 48 + x2 * (105 / 1408))))
    return where(x < SERIES, series, 1.5 * (asin(y) - y * sqrt(maximum(1.0 - y * y, 0.0))) / (y * y * y))


@pointwise
def softened(s, r):
    """s at the slip bound of the flow, its ratio to s, and the derivatives of its logarithm by ln s and ln r."""
    fall = 1.0 / maximum(r * r, MOST_R * MOST_R)
    least = 1.0 / (MOST_R * MOST_R) - fall + LEAST_S
    square = s * s + least * least
    return sqrt(square), s * s / square, where(r > MOST_R, 2.0 * fall, 0.0) * least / square


@pointwise
def circular_flow(s, r):
    """Flow along the sliding relative to Newtonian oil, and its derivatives by ln s and ln r."""
    soft, soft_s, soft_r = softened(s, r)
    t = minimum(soft, 1.0)
    K2 = minimum(1.0 + r * r, 1.0 / t)
    K, slipping = sqrt(K2), (1.0 + r * r) * t > 1.0
    cos, shape = sqrt(maximum(1.0 - t * t * K2, TINY)), wedge(t * K)
    cubed, part = K2 * K, 1.0 / maximum(soft, 1.0)
    slips = where(slipping, 3.0 / t * (r - sqrt(maximum(K2 - 1.0, 0.0))), 0.0)
    flow = cubed * shape + slips
    by_t = where(soft < 1.0, 3.0 * cubed * (1.0 / cos - shape) - slips, -flow)
    by_r = where(slipping, 3.0 * r / t, 3.0 * K * r * r / cos) + by_t * soft_r
    return flow * part, by_t * soft_s * part, by_r * part


@pointwise
def circular_stress(s, r):
    """Stress in the middle of the film over tau_L; at the walls it differs by s."""
    t = minimum(maximum(s, LEAST_S), 1.0)
    K2 = minimum(1.0 + r * r, 1.0 / t)
    return sqrt(maximum((K2 - 1.0) * (1.0 / K2 - t * t), 0.0))


@pointwise
def circular_slip(s, r):
    """Part of the sliding that is slip of the oil along a wall."""
    t = minimum(maximum(s, LEAST_S), 1.0)
    return maximum(1.0 - sqrt(1.0 / t - 1.0) / maximum(r, SLIDING), 0.0)
