"""Pressure-driven flow of a film with one viscosity between sliding walls, by the shear law of the scene.

Each function returns the flow relative to Newtonian oil and its derivatives by ln wall, ln newtonian and p (1/Pa), see
:class:`tehl_taichi.laws.law.ShearLaw`. Along the sliding the flow is exact. Across it, it is the flow without sliding over the
share of the viscosity that remains at the stress of the sliding (exact for small gradients).
"""

from tehl_taichi.engine.pointwise import pointwise, unrolled
from tehl_taichi.laws.rheology import DP, LARGEST, LAWS, secant
from tehl_taichi.laws.tangent_circle import touching_flow, touching_slip, touching_stress

RISE = 1e-5  # of a difference quotient by a stress, a part of it


@unrolled
def flow(rheology, wall, newtonian, p):
    """Flow along the sliding without its steep part, which Newton's method treats separately."""
    return (LAWS[rheology.law].flow or touching_flow)(rheology, wall, newtonian, p)


@unrolled
def beyond(rheology, wall, newtonian, p):
    """Steep part of the flow along the sliding."""
    law, nothing = LAWS[rheology.law].beyond, 0.0 * wall
    return law(rheology, wall, newtonian, p) if law else (nothing, nothing, nothing, nothing)


@unrolled
def mean_stress(rheology, wall, newtonian, p):
    """Stress (Pa) in the middle of the film."""
    return (LAWS[rheology.law].mean_stress or touching_stress)(rheology, wall, newtonian, p)


@unrolled
def wall_slip(rheology, wall, newtonian, p):
    """Part of the sliding that is slip along a wall."""
    law = LAWS[rheology.law]
    none = None if law.flow else touching_slip
    return (law.slip or none)(rheology, wall, newtonian, p) if law.slip or none else 0.0 * wall


@unrolled
def wall_limit(rheology, p):
    """Largest stress (Pa) that a wall can carry."""
    law = LAWS[rheology.law].limit
    return law(rheology, p) if law else 0.0 * p + LARGEST


@pointwise
def left_of(rheology, newtonian, p):
    """Share of the viscosity that remains, and the derivatives of minus its logarithm by ln newtonian and p. (A loop, so that
    kernels contain the law once.)
    """
    here, more, behind = 0.0 * newtonian, 0.0 * newtonian, 0.0 * newtonian
    for n in range(3):
        first, second = n * (2 - n), 0.5 * (n * (n - 1))
        b = secant(rheology, newtonian * (1.0 + RISE * first), p + DP * second)
        here, more, behind = here + b * (1.0 - first - second), more + b * first, behind + b * second
    return here, (here / more - 1.0) / RISE, (here / behind - 1.0) / DP


@pointwise
def sheared(b, by_newtonian, by_p, part, part_by_wall, part_by_p):
    """Flow across the sliding, from the flow without sliding."""
    return part / b, part_by_wall / b, part / b * by_newtonian, (part_by_p + part * by_p) / b


@unrolled
def across(rheology, wall, yielding, newtonian, p):
    """Smooth and steep part of the flow across the sliding, each for its own wall stress."""
    left, none = left_of(rheology, newtonian, p), 0.0 * newtonian
    parts = flow(rheology, wall, none, p), beyond(rheology, yielding, none, p)
    return tuple(sheared(*left, part, by_wall, by_p) for part, by_wall, _, by_p in parts)


@unrolled
def along(rheology, wall, yielding, newtonian, p):
    """Smooth and steep part of the flow along the sliding."""
    return flow(rheology, wall, newtonian, p), beyond(rheology, yielding, newtonian, p)


@unrolled
def either(rheology, slides, wall, yielding, newtonian, p):
    """Smooth and steep part of the flow along the sliding, or across it."""
    return (along if slides else across)(rheology, wall, yielding, newtonian, p)
