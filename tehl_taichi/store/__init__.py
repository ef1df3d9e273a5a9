"""Result stores: a zarr group per run that xarray opens, written step by step and readable after a crash.

`store` writes, `reader` reads, `layout` declares the arrays, `array_file` writes and reads one, `checkpoint` holds states to
resume from, `integrity`, `written_chunks` and `checked_zarr` (for xarray) find damage. `load_scene` finds a scene by name, file
or store. May import: disk, values, laws, scene, heat, march.
"""
