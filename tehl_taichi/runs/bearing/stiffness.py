"""Stiffness of one element between the rings: Q = c delta^n, with the total approach delta of both contacts."""

import math

from tehl_taichi.scene import hertz

POINT, LINE = 1.5, 10 / 9  # n
ROLLER = 35948e3 * 1e3 ** (1 / 9)  # N/m^(10/9) of a steel roller 1 mm long (ISO/TS 16281: 35948 N/mm^(10/9))
STEEL = 206e9 / (1 - 0.3**2)  # Pa, E' of that roller


def approach(load, contact, E):
    """Approach (m) of two bodies in an elliptic contact under a load (N): 3 Q K/(pi E' b) (Johnson, Eq 4.26c)."""
    a, b, _ = hertz.ellipse(load, contact.R_x, contact.R_y, E)
    long, short = max(a, b), min(a, b)
    K, _ = hertz.elliptic_integrals(1 - (short / long) ** 2)
    return 3 * load * K / (math.pi * E * long)


def point_stiffness(contacts, E):
    """Stiffness c (N/m^1.5) of a ball between its two contacts."""
    return sum(approach(1.0, contact, E) for contact in contacts) ** -POINT


def line_stiffness(length, E):
    """Stiffness c (N/m^(10/9)) of a roller between its two contacts (ISO/TS 16281), proportional to E'."""
    return ROLLER * (length * 1e3) ** (8 / 9) * E / STEEL


def of_bearing(bearing, contacts, E):
    """(c, n) of a bearing with the contacts of its two rings."""
    if bearing.rollers:
        return line_stiffness(bearing.length, E), LINE
    return point_stiffness(contacts.values(), E), POINT
