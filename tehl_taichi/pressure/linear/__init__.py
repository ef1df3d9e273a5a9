"""The linear solve of a Newton step: `interface` is all that Newton sees of it.

`multigrid_gmres` implements it on processors: FGMRES with an additive line multigrid preconditioner, as one kernel. `solver`
owns the fields and starts the kernel; `schedule` is the order of its phases, `operations` the work of each phase. `gmres` takes
the decisions between phases; `line_solver`, `transfer`, `convolution`, `preconditioner` are its parts; `red_black` is another
order of the lines.
"""
