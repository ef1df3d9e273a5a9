"""Density of Dowson & Higginson's form, with a temperature factor."""

import math

from tehl_taichi.engine.pointwise import exp, pointwise
from tehl_taichi.laws.densities import RHO0
from tehl_taichi.laws.law import SPARE, DensityLaw
from tehl_taichi.values.quantity import quantity
from tehl_taichi.values.registry import Checked


@pointwise
def compression(oil, p):
    """1 + D1 p / (1 + D2 p)."""
    return 1 + oil.D1 * p / (1 + oil.D2 * p)


@pointwise
def expansion(oil, p, Gamma):
    """1 - beta(p) (Gamma - 40), beta = beta0 exp(-beta_c p)."""
    return 1 - oil.beta0 * exp(-oil.beta_c * p) * (Gamma - 40)


@pointwise
def expansivity(oil, p, Gamma):
    """Expansivity: beta over that factor, 1/K."""
    return oil.beta0 * exp(-oil.beta_c * p) / expansion(oil, p, Gamma)


def refused(oil, Gamma, p):
    """Reason if the temperature factor falls too low; "" otherwise."""
    left = expansion(oil, 0.0, Gamma)
    return "" if oil.expansion == "never" or left >= SPARE else (
        f"oil.beta0 = {oil.beta0:g} 1/K leaves {left:.3g} of the density at the inlet temperature of {Gamma:g} deg C; allowed: "
        f"at least {SPARE:g}")


DOWSON_HIGGINSON = DensityLaw(
    name="dowson-higginson", says="(1 + D1 p/(1 + D2 p)) (1 - beta0 exp(-beta_c p) (Gamma - 40))",
    source="Dowson & Higginson 1966; temperature and numbers: Larsson et al. 2000", compression=compression,
    expansion=expansion, expansivity=expansivity, refused=refused,
    numbers={"rho0": RHO0, "D1": quantity(0.69e-9, "1/Pa", "1 + D1 p/(1 + D2 p)", 0, 1e-7),
             "D2": quantity(2.55e-9, "1/Pa", "see D1", 0, 1e-7),
             "beta0": quantity(6.8e-4, "1/K", "thermal factor 1 - beta0 exp(-beta_c p) (Gamma - 40)", 0, 1e-2),
             "beta_c": quantity(1.5e-9, "1/Pa", "see beta0", 0, 1e-7)},
    checked=(Checked("by hand at 1 GPa: 1 + 0.69/3.55", 1 + 0.69 / 3.55, lambda: compression(DOWSON_HIGGINSON.having(), 1e9)),
             Checked("their own numbers, (5.9e8 + 1.34 p)/(5.9e8 + p) at 1 GPa", 1.93 / 1.59,
                     lambda: compression(DOWSON_HIGGINSON.having(D1=0.34 / 5.9e8, D2=1 / 5.9e8), 1e9)),
             Checked("by hand at 1 GPa and 90 deg C: 1 - 0.034 e^-1.5", 1 - 0.034 * math.exp(-1.5),
                     lambda: expansion(DOWSON_HIGGINSON.having(), 1e9, 90.0)),
             Checked("by hand at p = 0 and 90 deg C: 6.8e-4/(1 - 0.034)", 6.8e-4 / 0.966,
                     lambda: expansivity(DOWSON_HIGGINSON.having(), 0.0, 90.0))))
