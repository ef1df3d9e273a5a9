"""Whole runs: one (`single_run`), many (`sweep`), gear flanks, bearings, cams; comparisons (`compare`); their summaries.

`stored_run` is the Run of Python, `recorder` writes a march into a store, `progress` is the protocol of progress reports.
`open_results` opens any results folder. Numerical libraries are imported when they are used. May import: every room but report
and the commands.
"""
