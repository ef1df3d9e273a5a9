"""Zoom: a fine window that moves with a feature through the states of a run on a coarser grid.

`window` is its position and size, `base_states` interpolates the states of the run in time, `outside_gap` is the deflection by
the pressure outside the window. `window_levels` holds its tables, `window_heat` its temperatures, `window_passage` its time
steps, and `zoomed_passage` its whole passage. `zoomed_reader` reads the run with its window, for the fatigue search.
"""
