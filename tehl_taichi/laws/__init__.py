"""Laws of the lubricant and fatigue criteria: pointwise functions for numbers, arrays and kernels.

A law is one file in `shear`, `viscosities`, `densities`, `criteria` or `hardness`: function, numbers with ranges, source, known
values. `rheology`, `viscosity`, `density` call the law that a scene chose; `choices` lists all laws. Laws know no scenes. May
import: values, engine.pointwise.
"""
