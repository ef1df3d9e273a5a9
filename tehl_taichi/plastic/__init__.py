"""Plastic flow of the steel below the surface: plastic strain, residual stress and surface change that a passage leaves.

`half_space` computes residual stress and surface displacement of plastic strain in layers; `flow` is the return mapping at
points; `steel_body` follows a body through the moments of a passage; `elastic_loads` finds its elastic stresses.
`surface_change` is the change as a passage uses it, `run_in` repeats passages. May import: values, laws, scene, fatigue.
"""
