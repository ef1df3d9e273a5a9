"""Roelands' viscosity without temperature."""

import math

from tehl_taichi.engine.pointwise import exp, log, pointwise
from tehl_taichi.laws.law import ViscosityLaw
from tehl_taichi.laws.viscosities import ALPHA, ETA0, P_R
from tehl_taichi.values.quantity import quantity
from tehl_taichi.values.registry import Checked


@pointwise
def ln_eta(oil, p, Gamma):
    """eta0 exp{(alpha p_r/Z)(-1 + (1 + p/p_r)^Z)}."""
    return log(oil.eta0) + oil.alpha * oil.p_r / oil.Z * (exp(oil.Z * log(1 + p / oil.p_r)) - 1)


ROELANDS = ViscosityLaw(
    name="roelands", says="eta0 exp((alpha p_r/Z) ((1 + p/p_r)^Z - 1)), no temperature",
    source="Roelands 1966, as Venner & Lubrecht (2000) write it", ln_eta=ln_eta, usual=("p_r",), thinned_by=(),
    numbers={"eta0": ETA0, "alpha": ALPHA, "Z": quantity(0.668, "", "pressure exponent", 1e-3, 3.0), "p_r": P_R},
    checked=(Checked("with Z = 1 it is Barus: ln 0.04 + 2.2e-8 * 0.7e9", math.log(0.04) + 15.4,
                     lambda: ln_eta(ROELANDS.having(Z=1.0), 0.7e9, 40.0)),
             Checked("by hand at p_r: the bracket is 2^0.668 - 1", math.log(0.04) + 4.312 * (2**0.668 - 1) / 0.668,
                     lambda: ln_eta(ROELANDS.having(), 1.96e8, 40.0))))
