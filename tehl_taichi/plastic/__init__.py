"""Plastic flow of the steel below the surface: what a passage leaves of it, as strain, residual stress and a new surface.

`half_space` answers plastic strain in layers with residual stress and sinking of the surface, `flow` is the return to the flow
stress at points, `steel_body` follows a body through moments of a passage, `elastic_loads` finds the stresses of these.
`surface_change` is what a passage sees of it, `run_in` repeats passages. May import: values, laws, scene, fatigue.
"""
