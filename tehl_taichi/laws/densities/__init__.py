"""Density laws, one file each: a new file here is a new choice of `oil.density`.

Densities are relative to rho_0, at p = 0 and 40 deg C; p in Pa, Gamma in deg C. May import what `laws` may.
"""

from tehl_taichi.values.quantity import quantity

RHO0 = quantity(853.0, "kg/m3", "density at p = 0 and 40 deg C", 100, 5000)
