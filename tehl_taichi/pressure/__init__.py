"""The pressure of a film of given temperatures: Reynolds equation, elastic deflection, cavitation, solid contact, load.

`fields` names the rows of the tables, `conditions` the numbers of a scene; `cell_faces`, `couette`, `reynolds`, `laws` and
`balances` are the discrete `equations`, `one_temperature` a film that they are solved for, `deflection` the bodies; `newton`
solves on the `levels` of `grids`, whose numbers are `level_numbers`, with `krylov`: the linear solve as one kernel that runs
the `program`, jobs of `phases` (with `convolution`, `lines`, `transfer`) and `decisions` between them; `preconditioner`
prepares it. `storage` is d/dt, by rows of `past` states, `tractions` the shear on both surfaces. May import `physics`,
`engine`, `scene`; nothing here knows of heat.
"""
