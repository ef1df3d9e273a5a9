"""The linear solve of a Newton step: `interface` is all that Newton sees of it.

`multigrid_gmres` implements it on processors: FGMRES with an additive line multigrid preconditioner, as one kernel. `solver`
owns the fields and starts the kernel. `schedule` is the order of its phases, `operations` the work of each phase, and `gmres`
decides between phases. `line_solver`, `transfer`, `convolution`, `preconditioner` are its parts; `red_black` is another order
of the lines; `cells` is the same solver for graphics cards. May import: engine, and the other modules of pressure.
"""
