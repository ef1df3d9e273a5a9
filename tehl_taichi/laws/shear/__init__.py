"""Shear laws, one file each: a new file here is a new choice of `rheology.law`.

Below: numbers that several of them use, and the limit of the shear stress, which also applies to solid contact. May import what
`laws` may.
"""

from tehl_taichi.engine.pointwise import pointwise
from tehl_taichi.values.quantity import quantity

TAU_0 = quantity(10e6, "Pa", "stress where the oil begins to thin", 1e3, 1e10)
TAU_L0 = quantity(10e6, "Pa", "limiting shear stress at p = 0", 1e3, 1e9)
GAMMA = quantity(0.075, "", "rise of the limiting shear stress with pressure", 0.0, 1.0)


@pointwise
def shear_limit(rheology, p):
    """Limiting shear stress tau_L0 + gamma p, Pa."""
    return rheology.tau_L0 + rheology.gamma * p
