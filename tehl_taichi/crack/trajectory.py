"""Trajectory of a crack: everywhere normal to the largest principal stress of the uncracked body at one moment.

After Hannes & Alfredsson 2011 (Eng. Fract. Mech. 78, 2848), who followed it in the plane of symmetry below an asperity.
"""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.crack.symmetry_plane import principal

STEP = 5e-3     # of the length
NOTHING = 1e-3  # of the largest stress: less tension is within its error
NEAR = 1.5      # half widths of the feature: tension farther from its centre is not its own


@dataclass(frozen=True)
class CrackStart:
    """Start of a crack: x (m) of the largest surface tension on one side, that tension (Pa), and the number of its moment."""

    x: float
    sigma1: float
    moment: int


def start(plane, side, x=None):
    """Find the :class:`CrackStart` on one side of the feature, or at a given x (m); None if nothing is under tension.

    side: "entry" is behind the feature's centre, with the moments before the centre reaches the middle of the contact; "exit"
    is ahead of it, with the other moments.
    """
    sign = -1 if side == "entry" else 1
    moments = np.flatnonzero(sign * plane.centres > 0)  # not the unloaded one
    from_feature = sign * plane.distance[:, moments]
    near = (from_feature > 0) & (from_feature < NEAR * plane.reach) if x is None else np.ones((1, moments.size), bool)
    rows = near.any(axis=1)
    if not rows.any():
        return None
    places = plane.x[rows] if x is None else np.array([x])
    tension = np.where(near[rows], principal(plane.at(places + 0j, moments))[0], -np.inf)
    at, moment = np.unravel_index(int(np.argmax(tension)), tension.shape)
    largest = float(tension[at, moment])
    return CrackStart(float(places[at]), largest, int(moments[moment])) if largest > NOTHING * plane.scale else None


def trajectory(plane, origin, length):
    """Trajectory from the mouth on, by midpoint steps. Returns (points (m, complex), largest principal stress (Pa) at them)."""
    da, z, way = STEP * length, complex(origin.x, 0.0), 1j
    points: list[complex] = []
    tension: list[float] = []
    while len(points) * da <= length and plane.holds(z):
        value, direction = _principal_direction(plane, z, origin.moment, way)
        points.append(z)
        tension.append(value)
        middle = z + da / 2 * direction
        if not plane.holds(middle):
            break
        way = _principal_direction(plane, middle, origin.moment, direction)[1]
        z = z + da * way
    return np.array(points), np.array(tension)


def _principal_direction(plane, z, moment, way):
    """Largest principal stress at z, and the unit direction normal to it that continues along `way`."""
    stress = plane.at(np.array([z]), slice(moment, moment + 1))[0, 0]
    value, angle = principal(stress)
    direction = 1j * np.exp(1j * angle)
    return float(value), direction if (direction * np.conj(way)).real >= 0 else -direction
