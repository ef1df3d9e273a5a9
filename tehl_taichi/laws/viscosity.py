"""Viscosity of an oil by its law."""

from tehl_taichi.engine.pointwise import unrolled
from tehl_taichi.laws import viscosities
from tehl_taichi.laws.law import ViscosityLaw
from tehl_taichi.values.registry import collect

LAWS = collect(viscosities, ViscosityLaw)  # choices of oil.viscosity


@unrolled
def ln_eta(oil, p, Gamma):
    """ln of the viscosity (Pa s) at p (Pa) and Gamma (deg C)."""
    return LAWS[oil.viscosity].ln_eta(oil, p, Gamma)


@unrolled
def parts(oil):
    """Number of terms of its law that depend on the temperature alone and are worth storing."""
    return len(LAWS[oil.viscosity].parts)


@unrolled
def part(oil, Gamma, n):
    """The n-th of these terms."""
    return LAWS[oil.viscosity].parts[n](oil, Gamma)


@unrolled
def ln_eta_of(oil, p, Gamma, values):
    """:func:`ln_eta` from stored terms."""
    return LAWS[oil.viscosity].of_parts(oil, p, *values) if values else ln_eta(oil, p, Gamma)
