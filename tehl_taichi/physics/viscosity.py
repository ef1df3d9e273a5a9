"""The viscosity of an oil by the law that it chose."""

from tehl_taichi.engine.pointwise import unrolled
from tehl_taichi.physics import viscosities
from tehl_taichi.physics.law import ViscosityLaw
from tehl_taichi.registry import collect

LAWS = collect(viscosities, ViscosityLaw)  # choices of oil.viscosity


@unrolled
def ln_eta(oil, p, Gamma):
    """ln of the viscosity (Pa s) at p (Pa) and Gamma (deg C)."""
    return LAWS[oil.viscosity].ln_eta(oil, p, Gamma)
