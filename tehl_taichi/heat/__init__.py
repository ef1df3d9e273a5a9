"""The temperatures of the film and of both bodies: the energy equation in the columns of the film, one step at a time.

`temperatures` is that step; `slots` names the numbers of a column, `across` its nodes, `film` its flow, `paths` where the oil
came from, `energy` the implicit step, `bodies` and `modes` the heat in the solids. May import `pressure` and what that may.
"""
