"""The viscosity of an oil by the law that it chose."""

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
    """Number of the parts of its law that depend on the temperature alone and are worth keeping."""
    return len(LAWS[oil.viscosity].parts)


@unrolled
def part(oil, Gamma, n):
    """The n-th of them."""
    return LAWS[oil.viscosity].parts[n](oil, Gamma)


@unrolled
def ln_eta_of(oil, p, Gamma, values):
    """:func:`ln_eta` where the values of its parts are known."""
    return LAWS[oil.viscosity].of_parts(oil, p, *values) if values else ln_eta(oil, p, Gamma)
