"""What the passage does to the material: stresses at and below the surface, critical planes, the fatigue index.

`half_space`, `rectangle`, `row_stress` (elastic), `thermal_stress`, `thermal_depth`; `histories` of material points; `findley`
searches by one of `criteria`, its kernels are in `critical_planes` and `circle`; `assessment` is the whole. Usable for other
people's stress histories: it rests on `criteria`, `scene` and `engine` alone.
"""
