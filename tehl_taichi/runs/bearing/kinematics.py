"""Speeds in a bearing whose elements roll without gross slip: cage, elements, entrainment, contact rates, spin."""

import math
from dataclasses import dataclass

from tehl_taichi.runs.bearing.ring_contacts import INNER, OUTER


@dataclass(frozen=True)
class BearingSpeeds:
    """cage, element: angular speeds of the cage, and of an element about its own axis relative to the cage (rad/s); u_m:
    entrainment speed of both contacts (m/s); passes: {ring: elements per second that pass one of its points}; element_passes:
    contacts per second of a point of the element with either ring; spin: {ring: spin of the ring on the element (rad/s)} under
    outer raceway control.
    """

    cage: float
    element: float
    u_m: float
    passes: dict
    element_passes: float
    spin: dict


def speeds(bearing, contacts):
    """The :class:`BearingSpeeds` of a bearing with the :class:`RingContact` of both rings."""
    inner, outer = (2 * math.pi / 60 * n for n in (bearing.speed, bearing.outer_speed))
    r_i, r_o = contacts[INNER].r, contacts[OUTER].r
    cage = (inner * r_i + outer * r_o) / (r_i + r_o)
    u_m = abs(inner - outer) * r_i * r_o / (r_i + r_o)
    element = 2 * u_m / bearing.diameter
    passes = {ring: bearing.count * abs(speed - cage) / (2 * math.pi) for ring, speed in ((INNER, inner), (OUTER, outer))}
    spin = {INNER: total_spin(bearing, contacts), OUTER: 0.0}
    return BearingSpeeds(cage, element, u_m, passes, element / math.pi, spin)


def total_spin(bearing, contacts):
    """Total spin (rad/s) of both contacts, |omega_i - omega_o| sin(alpha), however it is shared.

    Tapered rollers roll about a common apex and have none. Under outer raceway control (Jones 1959) the inner ring has all of
    it.
    """
    if bearing.rollers:
        return 0.0
    return 2 * math.pi / 60 * abs(bearing.speed - bearing.outer_speed) * math.sin(contacts[OUTER].angle)


def centrifugal_force(bearing, speeds, density):
    """Centrifugal force of an element (N); density: of its material, kg/m3."""
    D = bearing.diameter
    volume = math.pi * D**2 / 4 * bearing.length if bearing.rollers else math.pi * D**3 / 6
    return density * volume * bearing.pitch_diameter / 2 * speeds.cage**2
