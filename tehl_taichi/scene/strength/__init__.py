"""Strength of a body over its depth: fatigue limit, kappa, yield stress and residual stress.

`table_file` reads the user's tables, `profiles` has built-in ones, `table` holds the numbers, `strength` gives the values at a
depth. May import what `scene` may, but not `scene.sections`.
"""
