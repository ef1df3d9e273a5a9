"""Density of an oil over rho_0 by its law, p in Pa, Gamma in deg C; `oil.expansion` says where its thermal factor applies."""

from tehl_taichi.engine.pointwise import unrolled
from tehl_taichi.laws import densities
from tehl_taichi.laws.law import DensityLaw
from tehl_taichi.values.registry import collect

LAWS = collect(densities, DensityLaw)  # choices of oil.density


def _density(oil, p, Gamma, expands):
    """rho / rho_0, with or without the thermal factor."""
    law = LAWS[oil.density]
    cold = law.compression(oil, p)
    return cold * law.expansion(oil, p, Gamma) if expands else cold


@unrolled
def rho_film(oil, p, Gamma):
    """Density of a thermal film; the thermal factor applies unless `oil.expansion` is "never"."""
    return _density(oil, p, Gamma, oil.expansion != "never")


@unrolled
def rho_ratio(oil, p, Gamma):
    """Density of an isothermal film; the thermal factor applies if `oil.expansion` is "always" (see Scene.film_oil)."""
    return _density(oil, p, Gamma, oil.expansion == "always")


@unrolled
def expansivity(oil, p, Gamma):
    """Expansivity -(1/rho) d rho/d Gamma of a thermal film, 1/K."""
    return LAWS[oil.density].expansivity(oil, p, Gamma) if oil.expansion != "never" else 0.0 * p
