"""Laws of the lubricant: pointwise functions that work in kernels, for numbers and for arrays.

A law is one file in `shear`, `viscosities` or `densities`: its function, its numbers, its source and its range (see `law`).
`rheology`, `viscosity`, `density` ask the law that a scene chose; `conduction`, `boundary` have one; `choices` has them all.
May import `values` and `engine.pointwise`; knows nothing of scenes, needs no taichi before a kernel asks.
"""
