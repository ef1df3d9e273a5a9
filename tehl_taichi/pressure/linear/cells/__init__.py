"""The linear solve for graphics cards: the mathematics of :mod:`tehl_taichi.pressure.linear.multigrid_gmres`, its jobs cells.

A job is a column of a block (a vector of W rows at one x), a wave, or a block of three nodes of a line; kernels are rows of
parallel loops, one after another, without a branch around them. `solver` owns the fields and launches the kernels; `sizes` are
the places of levels; `convolution` and `transforms` make the deflection and the distribution; `lines` solves along x by cyclic
reduction, `transfer` moves between levels, `vectors` is what FGMRES does with whole vectors, `sums` adds up. Imported only
where it is wanted.
"""
