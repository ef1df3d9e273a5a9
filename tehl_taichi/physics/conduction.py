"""Conductivity and heat capacity of the film (Larsson et al. 2000), p in Pa, Gamma in deg C."""

import taichi as ti

from tehl_taichi.scene.limits import GAMMA_MEASURED, P_MEASURED


@ti.pyfunc
def conductivity(oil: ti.template(), p):
    """k0 (1 + k1 p/(1 + k2 p)), W/mK."""
    q = ti.min(p, P_MEASURED)
    return oil.k0 * (1 + oil.k1 * q / (1 + oil.k2 * q))


@ti.pyfunc
def heat_capacity(oil: ti.template(), p, Gamma):
    """rho c = rho_0 c0 (1 + c1 p/(1 + c2 p)) (1 + b0 (1 + b1 p + b2 p^2) (Gamma - 22)), J/m3K."""
    q, T = ti.min(p, P_MEASURED), ti.min(Gamma, GAMMA_MEASURED)
    rise = 1 + oil.b0 * (1 + oil.b1 * q + oil.b2 * q * q) * (T - 22)
    return oil.rho0 * oil.c0 * (1 + oil.c1 * q / (1 + oil.c2 * q)) * rise
