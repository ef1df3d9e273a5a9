"""Sweeps: many cases of one scene, on local processes or a Dask cluster, resumable.

`plan` lists the cases (`axis_syntax`, `sampling`, `study_file` read them), `study_table` is the study on disk. `sweeping` runs
each `case` in a `pool` of `local_workers` or on a `dask_cluster`; `study_figures` draws results.
"""
