"""Error estimates: the same scene on coarser grids (`coarse_runs`), error bars, the influence of the domain, unresolved peaks.

`readings` are the numbers of one grid, `error_bars` extrapolates several of them, `domain_error` varies the border.
"""
