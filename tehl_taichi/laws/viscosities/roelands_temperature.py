"""Roelands' viscosity with temperature."""

import math

from tehl_taichi.engine.pointwise import exp, log, pointwise
from tehl_taichi.laws.law import ViscosityLaw
from tehl_taichi.laws.viscosities import LN10, PER_135, PER_LN10, S0
from tehl_taichi.values.quantity import quantity
from tehl_taichi.values.registry import Checked

P_ROELANDS = 5.1e-9  # 1/Pa, Roelands' pressure scale (1.96e8 Pa)
LOG_SCALE, LN_SCALE = 4.2, 9.67  # of his viscosity scale (6.31e-5 Pa s), less their signs: log10 and ln


@pointwise
def ln_eta0(oil, Gamma):
    """ln of the viscosity at p = 0: log10 eta0 = -4.2 + G0 (1 + Gamma/135)^-S0 (Everitt 2018, Eq 1.2)."""
    return LN10 * (-LOG_SCALE + oil.G0 * exp(-oil.S0 * log(1 + Gamma * PER_135)))


@pointwise
def exponent(oil, Gamma):
    """Z(Gamma) = D_z + C_z log10(1 + Gamma/135) (Eq 1.3)."""
    return oil.Dz + oil.Cz * log(1 + Gamma * PER_135) * PER_LN10


@pointwise
def risen(oil, p, ln0, Z):
    """Roelands' rise from ln0, the viscosity at p = 0 (Eq 1.1)."""
    return ln0 + (ln0 + LN_SCALE) * (exp(Z * log(1 + P_ROELANDS * p)) - 1)


@pointwise
def ln_eta(oil, p, Gamma):
    """Eq 1.1 to 1.3."""
    return risen(oil, p, ln_eta0(oil, Gamma), exponent(oil, Gamma))


def refused(oil, Gamma, p):
    """Reason if the viscosity does not rise with pressure."""
    Z = exponent(oil, Gamma)
    return "" if Z > 0 else (
        f"oil.Dz = {oil.Dz:g}, Cz = {oil.Cz:g}: the viscosity does not rise with pressure at the inlet temperature of "
        f"{Gamma:g} deg C, Z = Dz + Cz log10(1 + T/135) = {Z:.3g}; allowed: more than 0")


ROELANDS_TEMPERATURE = ViscosityLaw(
    name="roelands-temperature", says="Roelands, its viscosity at p = 0 and its pressure exponent falling with temperature",
    source="Roelands 1966; Everitt 2018, Eq 1.1-1.3", ln_eta=ln_eta, parts=(ln_eta0, exponent), of_parts=risen,
    refused=refused,
    numbers={"G0": quantity(4.57, "", "log10 eta0 = -4.2 + G0 (1 + Gamma/135)^-S0, eta0 in Pa s", 0, 20), "S0": S0,
             "Dz": quantity(0.5, "", "pressure exponent Z = Dz + Cz log10(1 + Gamma/135)", -5, 5),
             "Cz": quantity(-0.071, "", "see Dz", -5, 5)},
    checked=(Checked("property table of the PAO: 2840 Pa s at 1.93 GPa and 90 deg C", math.log(2840),
                     lambda: ln_eta(ROELANDS_TEMPERATURE.having(), 1.93e9, 90.0), rel=2e-3),
             Checked("by hand at p = 0 and 90 deg C: 1 + 90/135 = 5/3, (5/3)^-1.25 = 0.528067, -4.2 + 4.57 * 0.528067",
                     -1.786734, lambda: ln_eta(ROELANDS_TEMPERATURE.having(), 0.0, 90.0) / LN10, rel=1e-6)))
