"""Whole runs: one from its scene to its summary, as `tehl run` does it, and many of them.

`single` runs, resumes and opens, with `recorder`, the march into a store; `stored_run` is what comes back, `progress` what it
tells while it runs, `checkup` a self-test; `compare` puts runs side by side.
Many: `plan` is what a sweep varies (`typed`, `sampling`, `study_file` read it), `table` the study on disk, `many` runs each
`case` over `pool`, here or on a `cluster`. May import every room but the commands; importing it costs nothing: what computes
and what reads files is imported when it is called.
"""
