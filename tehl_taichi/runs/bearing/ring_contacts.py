"""Geometry of the contacts of a rolling element with both rings: reduced radii, and distances from the axis of the bearing."""

import math
from dataclasses import dataclass

INNER, OUTER = RINGS = ("inner", "outer")


@dataclass(frozen=True)
class RingContact:
    """ring: inner or outer; R_x, R_y: reduced radii along rolling and across it (m; inf: straight rollers); R_d: radius of the
    pressed surface across (m; inf: rollers); r: distance of the contact from the axis of the bearing (m); angle: of its normal
    to the plane of the bearing (rad)."""

    ring: str
    R_x: float
    R_y: float
    R_d: float
    r: float
    angle: float


def contacts(bearing, angle=None):
    """{ring: its :class:`RingContact`} of a bearing; angle: contact angle under load (rad; default: that without load)."""
    alpha = bearing.alpha if angle is None else angle
    return {INNER: _contact(bearing, INNER, -1, alpha - 2 * bearing.nu, alpha - bearing.nu),
            OUTER: _contact(bearing, OUTER, 1, alpha, alpha - bearing.nu)}


def _contact(bearing, ring, side, angle, axis_angle):
    """Contact with one ring: 1/R_x is 2 cos(nu)/D of the element, plus (inner) or minus (outer) cos(angle)/r of the ring."""
    D = bearing.diameter
    r = bearing.pitch_diameter / 2 + side * D / 2 * math.cos(axis_angle)
    R_x = 1 / (2 * math.cos(bearing.nu) / D - side * math.cos(angle) / r)
    if bearing.rollers:
        return RingContact(ring, R_x, bearing.crown, math.inf, r, angle)
    f = bearing.osculation_inner if ring == INNER else bearing.osculation_outer
    return RingContact(ring, R_x, f * D / (2 * f - 1), 2 * f * D / (2 * f + 1), r, angle)
