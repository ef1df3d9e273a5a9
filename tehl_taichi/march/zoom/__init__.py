"""Zoom: a fine window that rides with a feature through the states of a run on a coarser grid.

`window` says where it lies, `refining` takes fields from the nodes of the run to its own, `base_states` are those of the run,
`outside_gap` is the film that the pressure outside bends, `window_levels` its tables and `window_passage` its march in time.
"""
