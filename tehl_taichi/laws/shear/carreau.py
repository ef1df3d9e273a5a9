"""Carreau's power law."""

from math import sqrt

from tehl_taichi.engine.pointwise import absolute, exp, log, maximum, pointwise, where
from tehl_taichi.laws.law import ShearLaw
from tehl_taichi.laws.shear import TAU_0
from tehl_taichi.values.quantity import quantity
from tehl_taichi.values.registry import Checked

TINY, LEAST = 1e-30, 1e-6  # stresses over tau_0
# places z and weights of Gauss' five nodes, numbered j = -2 to 2: polynomials in j, so that kernels need no table
Z, WEIGHT = (0.0, 0.5384693101056831, 0.9061798459386640), (0.2844444444444444, 0.2393143352496833, 0.1184634425280945)
Z_3 = (Z[2] / 2 - Z[1]) / 3
Z_1 = Z[1] - Z_3
W_0 = WEIGHT[0]
W_4 = ((WEIGHT[2] - W_0) / 4 - (WEIGHT[1] - W_0)) / 3
W_2 = WEIGHT[1] - W_0 - W_4
RATES, MEANS = 3, 6  # Newton steps; 2 of the rates leave derivatives that are wrong by 8e-4 at n = 0.3


@pointwise
def stress(rheology, newtonian, p):
    """newtonian (1 + (newtonian/tau_0)^2)^((n - 1)/2)."""
    r = newtonian / rheology.tau_0
    return newtonian * exp(0.5 * (rheology.carreau_n - 1) * log(1 + r * r))


@pointwise
def rate(rheology, tau):
    """(Newtonian stress over tau_0 at the stress tau over tau_0, its slope), by Newton in logarithms, starting from the
    asymptotes.
    """
    n, size = rheology.carreau_n, absolute(tau) + TINY
    log_size = log(size)
    y = log_size + 0.5 * (1 / n - 1) * log(1 + size * size)
    for _ in range(RATES):
        square = exp(2 * y)
        y -= (y + 0.5 * (n - 1) * log(1 + square) - log_size) / (1 + (n - 1) * square / (1 + square))
    N, square = exp(y), exp(2 * y)
    return where(tau < 0, -N, N), N / size / (1 + (n - 1) * square / (1 + square))


@pointwise
def summed(rheology, s, r):
    """Sums over nodes across the film, for wall stress s and sliding stress r, both over tau_0.

    Returns the stress in the middle of the film over tau_0 (by Newton from that of oil thinned by the gradient), and means of
    the rate times z (-1 to 1) and of its slope times 1, z, z^2.
    """
    n = rheology.carreau_n
    thin = exp(0.5 * (1 - 1 / n) * log(1 + 0.5 * s * s))
    mean = stress(rheology, r * rheology.tau_0 * thin, 0.0) / rheology.tau_0
    N_z, slope, slope_z, slope_zz = 0.0 * s, 0.0 * s, 0.0 * s, 0.0 * s
    for _ in range(MEANS):
        N, N_z, slope, slope_z, slope_zz = 0.0 * s, 0.0 * s, 0.0 * s, 0.0 * s, 0.0 * s
        for node in range(5):
            j = node - 2
            z, weight = j * (Z_1 + Z_3 * j * j), W_0 + j * j * (W_2 + W_4 * j * j)
            at, steep = rate(rheology, mean + z * s)
            N, N_z, slope = N + weight * at, N_z + weight * z * at, slope + weight * steep
            slope_z, slope_zz = slope_z + weight * z * steep, slope_zz + weight * z * z * steep
        mean -= (N - r) / slope
    return mean, N_z, slope, slope_z, slope_zz


@pointwise
def flow(rheology, wall, newtonian, p):
    """Flow from sums across the film (at most 0.4 % from the integral for n >= 0.3)."""
    s, r = maximum(wall / rheology.tau_0, LEAST), newtonian / rheology.tau_0
    mean, N_z, slope, slope_z, slope_zz = summed(rheology, s, r)
    part = 3 * N_z / s
    return part, 3 * (slope_zz - slope_z * slope_z / slope) - part, 3 * r * slope_z / slope / s, 0.0 * wall


@pointwise
def mean_stress(rheology, wall, newtonian, p):
    return rheology.tau_0 * summed(rheology, wall / rheology.tau_0, newtonian / rheology.tau_0)[0]


CARREAU = ShearLaw(
    name="carreau", says="s (1 + (s/tau_0)^2)^((carreau_n - 1)/2), s = eta * (shear rate)",
    source="Carreau 1972", stress=stress,
    flow=flow, mean_stress=mean_stress,
    numbers={"tau_0": TAU_0, "carreau_n": quantity(0.8, "", "exponent (1: newtonian)", 0.1, 1.0)},
    checked=(Checked("the integral across the film, summed at 20 000 places: 1.24 times as much at 3 tau_0, n = 0.8", 1.240,
                     lambda: flow(CARREAU.having(), 30e6, 0.0, 1e9)[0], 5e-3),
             Checked("by hand: (s/tau_0)^2 = 3 and n = 0.6 leave 2^-0.4", sqrt(3) * 6e6 * 2**-0.4,
                     lambda: stress(CARREAU.having(tau_0=6e6, carreau_n=0.6), sqrt(3) * 6e6, 1e9)),))
