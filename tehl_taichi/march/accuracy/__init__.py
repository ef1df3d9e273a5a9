"""Error estimates: runs of the scene on coarser grids (`coarse_runs`), error bars, influence of the domain, unresolved peaks.

`readings` are the numbers of one grid, `error_bars` extrapolates several of them, `domain_error` estimates the effect of the
border.
"""
