"""Viscosity laws, ln eta(p, Gamma), p in Pa, Gamma in deg C, eta in Pa s.

`oil` is a frozen :class:`tehl_taichi.scene.oil.Oil`; its field `viscosity` chooses the law at compile time.
"""

import taichi as ti

from tehl_taichi.engine.elementary import exp, log

LN10 = 2.302585092994046
PER_LN10 = 1 / LN10
PER_135 = 1 / 135  # 1/K; divisions by constants are not turned into products, and cost ten times as much
P_ROELANDS = 5.1e-9  # 1/Pa, Roelands' pressure scale (1.96e8 Pa)


@ti.pyfunc
def ln_eta0_walther(oil: ti.template(), Gamma):
    """ln of the viscosity at p = 0: log10 eta0 = -4.2 + G0 (1 + Gamma/135)^-S0 (Everitt 2018, Eq 1.2)."""
    return LN10 * (-4.2 + oil.G0 * exp(-oil.S0 * log(1 + Gamma * PER_135)))


@ti.pyfunc
def roelands_temperature(oil: ti.template(), p, Gamma):
    """Roelands with temperature, Z(Gamma) = D_z + C_z log10(1 + Gamma/135) (Everitt 2018, Eq 1.1-1.3)."""
    ln0 = ln_eta0_walther(oil, Gamma)
    Z = oil.Dz + oil.Cz * log(1 + Gamma * PER_135) * PER_LN10
    return ln0 + (ln0 + 9.67) * (exp(Z * log(1 + P_ROELANDS * p)) - 1)


@ti.pyfunc
def roelands(oil: ti.template(), p, Gamma):
    """eta0 exp{(alpha p_r/Z)(-1 + (1 + p/p_r)^Z)} (Venner & Lubrecht); no temperature."""
    return log(oil.eta0) + oil.alpha * oil.p_r / oil.Z * (exp(oil.Z * log(1 + p / oil.p_r)) - 1)


@ti.pyfunc
def barus(oil: ti.template(), p, Gamma):
    """eta0 exp(alpha p - beta_eta (Gamma - Gamma0)): Barus, with Reynolds' temperature factor."""
    return log(oil.eta0) + oil.alpha * p - oil.beta_eta * (Gamma - oil.Gamma0)


@ti.pyfunc
def houpert(oil: ti.template(), p, Gamma):
    """Roelands with Houpert's temperature factor ((Gamma + 135)/(Gamma_0 + 135))^-S_0 (Houpert 1985)."""
    ln0 = log(oil.eta0) + 9.67
    Z = oil.alpha * oil.p_r / ln0
    temperature = exp(-oil.S0 * log((Gamma + 135) / (oil.Gamma0 + 135)))
    return -9.67 + ln0 * exp(Z * log(1 + p / oil.p_r)) * temperature


@ti.pyfunc
def yasutomi(oil: ti.template(), p, Gamma):
    """Free-volume law of Yasutomi, Bair & Winer 1984: log10(eta/eta_g) = -C1 (Gamma - Tg) F / (C2 + (Gamma - Tg) F)."""
    Tg = oil.Tg0 + oil.A1 * log(1 + oil.A2 * p)
    F = 1 - oil.B1 * log(1 + oil.B2 * p)
    return log(oil.eta_g) - LN10 * oil.C1 * (Gamma - Tg) * F / (oil.C2 + (Gamma - Tg) * F)


@ti.pyfunc
def table(oil: ti.template(), p, Gamma):
    """Piecewise linear in p through the pairs of `oil.table` ((p, ln eta), ...), the end slopes continued."""
    out = oil.table[0][1] + 0.0 * p
    for n in ti.static(range(len(oil.table) - 1)):
        p0, p1 = oil.table[n][0], oil.table[n + 1][0]
        slope = (oil.table[n + 1][1] - oil.table[n][1]) / (p1 - p0)
        upper = p - p0 if ti.static(n == len(oil.table) - 2) else ti.min(p - p0, p1 - p0)
        out += slope * (ti.max(upper, 0.0) if ti.static(n > 0) else upper)
    return out


@ti.pyfunc
def ln_eta(oil: ti.template(), p, Gamma):
    """ln of the viscosity by the oil's own law."""
    out = 0.0 * p  # of the type of p: a number or lanes
    if ti.static(oil.viscosity == "roelands-temperature"):
        out = roelands_temperature(oil, p, Gamma)
    elif ti.static(oil.viscosity == "roelands"):
        out = roelands(oil, p, Gamma)
    elif ti.static(oil.viscosity == "barus"):
        out = barus(oil, p, Gamma)
    elif ti.static(oil.viscosity == "houpert"):
        out = houpert(oil, p, Gamma)
    elif ti.static(oil.viscosity == "yasutomi"):
        out = yasutomi(oil, p, Gamma)
    else:
        out = table(oil, p, Gamma)
    return out
