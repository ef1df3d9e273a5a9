"""Stresses in the bodies: elastic half-space under pressure and shear, thermal stress, their histories at material points.

`half_space` (all rows, one depth) and `row_stress` (some rows, many depths) sum the `rectangle` solutions by FFT,
`strip_stress` those of endless strips (plane strain).
`thermal_stress` and `thermal_depth` add heat; `histories` moves material points through the contact.
"""
