"""Flow of a film by a law that defines only its stress: the flow of the tangent circular law.

At the stress of the sliding (and of the gradient, which matters without sliding) the circular law a N/sqrt(1 + (a N/c)^2) has
the same stress and slope: exact for the circular law itself, and for every law if the gradient is small.
"""

from tehl_taichi.engine.pointwise import maximum, pointwise, sqrt, where
from tehl_taichi.laws.circular_law import circular_flow, circular_slip, circular_stress
from tehl_taichi.laws.rheology import DP, LARGEST, secant

STEP = 1e-4  # of the slope of the law, as a part of the stress
RISE = 1e-6  # of the derivatives of the flow
LEAST = 1.0  # Pa


@pointwise
def touching(rheology, wall, newtonian, p):
    """s and r of the tangent circular law, its a, and its limit c, Pa. (Loops, so that kernels contain the law once.)"""
    N = sqrt(newtonian * newtonian + wall * wall / 3.0 + LEAST * LEAST)
    b, rise = 0.0 * N, 0.0 * N
    for n in range(3):
        factor = 1.0 + STEP * (n - 1)
        left = secant(rheology, N * factor, p)
        b, rise = b + left * (n * (2 - n)), rise + left * (factor * (n - 1))
    k2 = maximum(b / maximum(rise / (2.0 * STEP), b / LARGEST), 1.0 + 1e-12)
    a, per = b * sqrt(k2), sqrt(k2 - 1.0) / N
    return wall * per / a, newtonian * per, a, a / per


@pointwise
def touching_flow(rheology, wall, newtonian, p):
    """Flow as in a :class:`tehl_taichi.laws.law.ShearLaw`, with derivatives by differences."""
    here, by_wall, by_newtonian, by_p = 0.0 * wall, 0.0 * wall, 0.0 * wall, 0.0 * wall
    for n in range(4):
        first, second, third = where(n == 1, 1.0, 0.0), where(n == 2, 1.0, 0.0), where(n == 3, 1.0, 0.0)
        s, r, a, c = touching(rheology, wall * (1.0 + RISE * first), newtonian * (1.0 + RISE * second), p + DP * third)
        value = circular_flow(s, r)[0] / a
        here, by_wall = here + value * (1.0 - first - second - third), by_wall + value * first
        by_newtonian, by_p = by_newtonian + value * second, by_p + value * third
    return here, (by_wall - here) / RISE, (by_newtonian - here) / RISE, (by_p - here) / DP


@pointwise
def touching_stress(rheology, wall, newtonian, p):
    s, r, a, c = touching(rheology, wall, newtonian, p)
    return c * circular_stress(s, r)


@pointwise
def touching_slip(rheology, wall, newtonian, p):
    s, r, a, c = touching(rheology, wall, newtonian, p)
    return circular_slip(s, r)
