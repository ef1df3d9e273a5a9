"""Measured height maps: reading, levelling, filtering, checking.

`height_map` reads a map, with `text_heights` and `coordinates`; `gaussian_filter`, `form`, `hole_filling`, `orientation` change
it. `map_warnings` reports doubts, `cutoff_choice` proposes a filter, `flattening_pressure` estimates the pressure that flattens
the map.
"""
