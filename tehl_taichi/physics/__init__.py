"""Laws of the lubricant: pointwise functions that work in kernels, for numbers and for arrays, and the film formulas.

Viscosity, density, shear laws, conductivity, boundary friction; each stands once, with its source. May import `scene` (what an
oil is) and `engine` (exp and log of lanes).
"""
