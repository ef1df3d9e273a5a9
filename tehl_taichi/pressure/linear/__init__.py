"""The linear solve of a Newton step: FGMRES with an additive line multigrid preconditioner, as one kernel.

`solver` owns the fields and starts the kernel; `schedule` is the order of its phases, `operations` the work of each phase.
`gmres` takes the decisions between phases; `line_solver`, `transfer`, `convolution`, `preconditioner` are its parts.
"""
