"""Barus' viscosity."""

import math

from tehl_taichi.engine.pointwise import log, pointwise
from tehl_taichi.laws.law import ViscosityLaw
from tehl_taichi.laws.viscosities import ALPHA, ETA0, GAMMA0
from tehl_taichi.values.quantity import quantity
from tehl_taichi.values.registry import Checked


@pointwise
def ln_eta(oil, p, Gamma):
    """eta0 exp(alpha p - beta_eta (Gamma - Gamma0)): Barus, with Reynolds' temperature factor."""
    return log(oil.eta0) + oil.alpha * p - oil.beta_eta * (Gamma - oil.Gamma0)


def doubted(oil, Gamma, p):
    """Reason for doubt: at high pressure exp(alpha p) exceeds measured viscosities by orders of magnitude."""
    return "" if p <= BARUS.most_p else (
        f"oil.viscosity = barus at a Hertz pressure of {p / 1e9:.2f} GPa is beyond the range of the law, about "
        f"{BARUS.most_p / 1e9:g} GPa")


BARUS = ViscosityLaw(
    name="barus", says="eta0 exp(alpha p - beta_eta (Gamma - Gamma0))", source="Barus 1893; Reynolds 1886 (temperature)",
    most_p=0.5e9, ln_eta=ln_eta, usual=("beta_eta", "Gamma0"), thinned_by=("beta_eta",), doubted=doubted,
    numbers={"eta0": ETA0, "alpha": ALPHA,
             "beta_eta": quantity(0.0, "1/K", "fall of ln(viscosity) with temperature", 0, 1), "Gamma0": GAMMA0},
    checked=(Checked("by hand: 2e-8 * 1e8 = 2, 0.03 * 50 = 1.5", math.log(0.1) + 0.5,
                     lambda: ln_eta(BARUS.having(eta0=0.1, alpha=2e-8, beta_eta=0.03), 1e8, 90.0)),))
