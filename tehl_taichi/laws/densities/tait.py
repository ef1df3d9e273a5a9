"""Tait's equation of state: unlike Dowson & Higginson's form, the density rises without a limit."""

import math

from tehl_taichi.engine.pointwise import exp, log, pointwise
from tehl_taichi.laws.densities import RHO0
from tehl_taichi.laws.law import SPARE, DensityLaw
from tehl_taichi.values.quantity import quantity
from tehl_taichi.values.registry import Checked

PEAK = 5.0  # times the Hertz pressure: up to there a volume must be left


@pointwise
def compressed(oil, p, Gamma):
    """Volume relative to p = 0 at the same temperature: 1 - ln(1 + (1 + K1) p/K)/(1 + K1), K = K00 exp(-beta_K T), T in K."""
    K = oil.tait_K00 * exp(-oil.tait_beta_K * (Gamma + 273.15))
    return 1 - log(1 + (1 + oil.tait_K1) * p / K) / (1 + oil.tait_K1)


@pointwise
def compression(oil, p):
    """Density rho/rho_0 at 40 deg C."""
    return 1 / compressed(oil, p, 40.0 + 0.0 * p)


@pointwise
def expansion(oil, p, Gamma):
    """Volume at 40 deg C over that at Gamma."""
    return compressed(oil, p, 40.0 + 0.0 * p) / (compressed(oil, p, Gamma) * (1 + oil.tait_a_V * (Gamma - 40)))


@pointwise
def expansivity(oil, p, Gamma):
    """Derivative d ln V/d Gamma: of V at p = 0, minus the effect of the softer oil (which dominates above 200 deg C and 1 GPa,
    where K is extrapolated).
    """
    x = (1 + oil.tait_K1) * p / (oil.tait_K00 * exp(-oil.tait_beta_K * (Gamma + 273.15)))
    softer = oil.tait_beta_K / (1 + oil.tait_K1) * x / (1 + x) / compressed(oil, p, Gamma)
    return oil.tait_a_V / (1 + oil.tait_a_V * (Gamma - 40)) - softer


def refused(oil, Gamma, p):
    """Reason if no volume is left at the largest pressures that a feature causes; "" otherwise."""
    left = compressed(oil, PEAK * p, max(Gamma, 40.0))
    return "" if left >= SPARE else (
        f"oil.tait_K00 = {oil.tait_K00:g} Pa with tait_beta_K = {oil.tait_beta_K:g} 1/K and tait_K1 = {oil.tait_K1:g} leaves "
        f"{left:.3g} of the volume at {PEAK * p:.3g} Pa; allowed: at least {SPARE:g}")


TAIT = DensityLaw(
    name="tait", says="1/((1 + a_V (Gamma - 40)) (1 - ln(1 + (1 + K1) p/K)/(1 + K1))), K = K00 exp(-beta_K T), T in K",
    source="Tait's equation in the form of Bair 2006 (Tribology Letters 22); numbers: for squalane, from memory, unchecked",
    compression=compression, expansion=expansion, expansivity=expansivity, refused=refused,
    numbers={"rho0": RHO0, "tait_K00": quantity(8.658e9, "Pa", "bulk modulus at p = 0, continued to 0 K", 1e9, 1e12),
             "tait_beta_K": quantity(6.332e-3, "1/K", "fall of the bulk modulus with temperature", 0.0, 0.02),
             "tait_K1": quantity(11.74, "", "rise of the bulk modulus with pressure, at p = 0", 4.0, 30.0),
             "tait_a_V": quantity(8.36e-4, "1/K", "expansion at p = 0", 0.0, 1e-2)},
    checked=(Checked("by hand, K = 12.74 GPa: 1 GPa leaves 1 - ln 2/12.74 of the volume", 1 / (1 - math.log(2) / 12.74),
                     lambda: compression(TAIT.having(tait_K00=12.74e9, tait_beta_K=0.0), 1e9)),
             Checked("by hand at p = 0 and 90 deg C: 1/(1 + 0.0418)", 1 / 1.0418,
                     lambda: expansion(TAIT.having(), 0.0, 90.0)),
             Checked("slope at p = 0, 40 deg C: 1/K = 0.839 1/GPa (squalane, by hand)", 0.8389e-9,
                     lambda: (compression(TAIT.having(), 1e3) - 1) / 1e3, 1e-3),
             Checked("by hand at p = 0 and 90 deg C: 8.36e-4/1.0418", 8.36e-4 / 1.0418,
                     lambda: expansivity(TAIT.having(), 0.0, 90.0))))
