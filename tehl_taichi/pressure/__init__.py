"""Pressure of a film with given temperatures: Reynolds equation, elastic deflection, cavitation, solid contact, load balance.

`equations` is the discrete system (`fluxes`, `upwind`, `reynolds`, `balances`), `newton` solves it on `levels` of grids.
`linear` solves the linearised system; `storage_term` is the time derivative, `tractions` the shear on both surfaces.
May import: engine, values, laws, scene. Temperatures are computed elsewhere (heat).
"""
