"""The temperatures of the film and of both bodies: the energy equation in the columns of the film, one step at a time.

`temperatures` is that step; `slots` names the quantities of a column, `step` its numbers, `across` and `nodes` its places;
`film` is its flow, `paths` where the oil came from, `foresight` what a step begins with, `energy` the implicit step (with
`elimination` and `relaxation`), `rest` where later rounds leave it out, `bodies`, `strips` and `modes` the heat in the solids.
May import `pressure` and what that may.
"""
