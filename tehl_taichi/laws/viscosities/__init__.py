"""Viscosity laws, one file each: a new file here is a new choice of `oil.viscosity`.

p in Pa, Gamma in deg C, eta in Pa s. Below: numbers and factors that several of them use. May import what `laws` may.
"""

from tehl_taichi.values.quantity import quantity

LN10 = 2.302585092994046
PER_LN10 = 1 / LN10
PER_135 = 1 / 135  # 1/K; divisions by constants are not turned into products, and cost ten times as much
S0 = quantity(1.25, "", "exponent of the temperature", 0, 10)
ETA0 = quantity(0.04, "Pa s", "viscosity at p = 0", 1e-6, 1e4, common=(1e-4, 5.0))
ALPHA = quantity(2.2e-8, "1/Pa", "rise of the viscosity with pressure", 1e-10, 1e-6)
P_R = quantity(1.96e8, "Pa", "pressure scale", 1e6, 1e10)
GAMMA0 = quantity(40.0, "deg C", "temperature of eta0", -100, 300)
