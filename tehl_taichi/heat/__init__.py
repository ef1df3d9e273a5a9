"""Temperatures of the film and of both bodies: one implicit step of the energy equation.

`temperatures` is the step; `film` the flow across the film, `energy` the equation, `departure_points` the origin of the oil,
`relaxation` that of the rounds with the pressure. `film_tables` names the fields of a column, `chebyshev` its nodes; `bodies`,
`strips`, `conduction_modes` are the heat in the solids. May import: engine, values, laws, scene, pressure.
"""
