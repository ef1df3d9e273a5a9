"""The linear solve for graphics cards: the mathematics of :mod:`tehl_taichi.pressure.linear.multigrid_gmres` with small jobs.

A job is one column of a block (a vector of W rows at one x), one wave, or a block of three nodes of a line. A kernel is a
sequence of parallel loops, without a branch around them. `solver` owns the fields and launches the kernels; `sizes` holds the
places of the levels. `convolution` and `transforms` compute the deflection and the distribution, `lines` solves along x by
cyclic reduction, `transfer` moves between levels, `vectors` holds the vector operations of FGMRES, `sums` adds up. Imported
only if a scene uses it.
"""
