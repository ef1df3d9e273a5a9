"""Density over rho_0 (p = 0, 40 deg C), p in Pa, Gamma in deg C."""

import taichi as ti

from tehl_taichi.engine.elementary import exp


@ti.pyfunc
def compression(oil: ti.template(), p):
    """1 + D1 p / (1 + D2 p) (Dowson & Higginson's form)."""
    return 1 + oil.D1 * p / (1 + oil.D2 * p)


@ti.pyfunc
def expansion(oil: ti.template(), p, Gamma):
    """1 - beta(p) (Gamma - 40), beta = beta0 exp(-beta_c p) (Larsson et al. 2000)."""
    return 1 - oil.beta0 * exp(-oil.beta_c * p) * (Gamma - 40)


@ti.pyfunc
def density(oil: ti.template(), p, Gamma, expands: ti.template()):
    """rho / rho_0, with or without the thermal factor."""
    out = compression(oil, p)
    if ti.static(expands):
        out = out * expansion(oil, p, Gamma)
    return out


@ti.pyfunc
def rho_film(oil: ti.template(), p, Gamma):
    """Of a film with temperatures; the thermal factor acts unless `oil.expansion` is "never"."""
    return density(oil, p, Gamma, oil.expansion != "never")


@ti.pyfunc
def expansivity(oil: ti.template(), p, Gamma):
    """-(1/rho) d rho/d Gamma, 1/K."""
    out = 0.0 * p
    if ti.static(oil.expansion != "never"):
        out = oil.beta0 * exp(-oil.beta_c * p) / expansion(oil, p, Gamma)
    return out


@ti.pyfunc
def rho_ratio(oil: ti.template(), p, Gamma):
    """Of a film with one temperature; the thermal factor acts when `oil.expansion` is "always"."""
    return density(oil, p, Gamma, oil.expansion == "always")
