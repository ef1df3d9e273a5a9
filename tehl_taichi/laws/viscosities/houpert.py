"""Houpert's viscosity."""

import math

from tehl_taichi.engine.pointwise import exp, log, pointwise
from tehl_taichi.laws.law import ViscosityLaw
from tehl_taichi.laws.viscosities import ALPHA, ETA0, GAMMA0, P_R, S0
from tehl_taichi.values.registry import Checked


@pointwise
def warmth(oil, Gamma):
    """Houpert's temperature factor ((Gamma + 135)/(Gamma_0 + 135))^-S_0."""
    return exp(-oil.S0 * log((Gamma + 135) / (oil.Gamma0 + 135)))


@pointwise
def warmed(oil, p, factor):
    """Roelands' law with that factor."""
    ln0 = log(oil.eta0) + 9.67
    Z = oil.alpha * oil.p_r / ln0
    return -9.67 + ln0 * exp(Z * log(1 + p / oil.p_r)) * factor


@pointwise
def ln_eta(oil, p, Gamma):
    """ln(eta): pressure and temperature part together."""
    return warmed(oil, p, warmth(oil, Gamma))


def refused(oil, Gamma, p):
    """Reason if eta0 lies below Roelands' pole at ln(eta) = -9.67."""
    return "" if math.log(oil.eta0) + 9.67 > 0 else (
        f"oil.eta0 = {oil.eta0:g} Pa s: Houpert's law needs ln(eta0) + 9.67 > 0; allowed: more than 6.32e-05 Pa s")


def _by_hand(S0=1.0):
    """Check value ln0 2^Z/1.5^S0 - 9.67 with ln0 = ln 0.04 + 9.67 and Z = 4.312/ln0."""
    ln0 = math.log(0.04) + 9.67
    return -9.67 + ln0 * 2 ** (4.312 / ln0) / 1.5**S0


HOUPERT = ViscosityLaw(
    name="houpert", says="Roelands, ln(eta) + 9.67 falling as ((Gamma + 135)/(Gamma0 + 135))^-S0", source="Houpert 1985",
    ln_eta=ln_eta, parts=(warmth,), of_parts=warmed, usual=("p_r",), thinned_by=("S0",), refused=refused,
    numbers={"eta0": ETA0, "alpha": ALPHA, "S0": S0, "Gamma0": GAMMA0, "p_r": P_R},
    checked=(Checked("by hand at p_r and (Gamma + 135)/(Gamma0 + 135) = 262.5/175 = 1.5, S0 = 1", _by_hand(),
                     lambda: ln_eta(HOUPERT.having(S0=1.0), 1.96e8, 127.5)),
             Checked("the same with S0 = 2", _by_hand(2.0), lambda: ln_eta(HOUPERT.having(S0=2.0), 1.96e8, 127.5))))
