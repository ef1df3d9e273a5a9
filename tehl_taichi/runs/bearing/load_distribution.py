"""Load of every rolling element, from the equilibrium of the inner ring (Stribeck 1901, Sjovall 1933; ISO/TS 16281 without
tilt).

The ring moves radially and axially. The compression delta of an element follows from its azimuth; its load is c delta^n.
"""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.errors import SceneError

HALVINGS = 80
FIRST, FARTHEST = 1e-6, 0.02  # m: displacements at which a bracket begins, and where no bearing is left


@dataclass(frozen=True)
class LoadDistribution:
    """azimuth: of the elements, the first in the direction of the load (rad); loads: normal to the contacts (N); angles:
    contact angles (rad); radial, axial: displacement of the inner ring (m) from the middle of its play, of a bearing with a
    contact angle from where its elements touch without load; axial_load: N; end_play: m, of balls without a contact angle."""

    azimuth: np.ndarray
    loads: np.ndarray
    angles: np.ndarray
    radial: float
    axial: float
    axial_load: float
    end_play: float

    @property
    def largest(self):
        """Load of the most loaded element, N."""
        return float(self.loads[0])

    @property
    def angle(self):
        """Contact angle of the most loaded element, rad."""
        return float(self.angles[0])

    @property
    def loaded(self):
        """Number of elements that carry a load."""
        return int(np.count_nonzero(self.loads > 0))


def distribution(bearing, stiffness):
    """The :class:`LoadDistribution` of a bearing; stiffness: (c, n) of :func:`tehl_taichi.runs.bearing.stiffness.of_bearing`.
    Raises SceneError if no displacement balances the load.
    """
    ring = _Displaced(bearing, *stiffness)
    axial = _axial_displacement(bearing, ring)
    radial = ring.radial_for(axial)
    loads, angles = ring.elements(radial, axial)
    return LoadDistribution(ring.azimuth, loads, angles, radial, axial - ring.centred, float(np.sum(loads * np.sin(angles))),
                            abs(2 * ring.centred))


class _Displaced:
    """Elements of a bearing whose inner ring is displaced."""

    def __init__(self, bearing, c, n):
        self.bearing, self.c, self.n = bearing, c, n
        self.azimuth = 2 * np.pi * np.arange(bearing.count) / bearing.count
        self.compression = self._of_rollers if bearing.rollers else self._of_balls
        A = bearing.groove_distance
        self.free = bearing.alpha or math.acos(max(1 - bearing.clearance / (2 * A), -1.0)) if A > 0 else 0.0

    @property
    def centred(self):
        """Axial displacement at which balls without a contact angle lie in the plane of their grooves."""
        return 0.0 if self.bearing.alpha or self.bearing.rollers else -self.bearing.groove_distance * math.sin(self.free)

    def _of_balls(self, radial, axial):
        A = self.bearing.groove_distance
        across, along = A * np.sin(self.free) + axial, A * np.cos(self.free) + radial * np.cos(self.azimuth)
        return np.hypot(across, along) - A, np.arctan2(across, along)

    def _of_rollers(self, radial, axial):
        alpha = self.bearing.alpha
        gap = (radial * np.cos(self.azimuth) - self.bearing.clearance / 2) * np.cos(alpha) + axial * np.sin(alpha)
        return gap, np.full(self.azimuth.shape, alpha)

    def elements(self, radial, axial):
        """(loads, contact angles) of all elements."""
        delta, angles = self.compression(radial, axial)
        return self.c * np.maximum(delta, 0.0) ** self.n, angles

    def forces(self, radial, axial):
        """(radial, axial) force of the inner ring on the elements, N."""
        loads, angles = self.elements(radial, axial)
        return float(np.sum(loads * np.cos(angles) * np.cos(self.azimuth))), float(np.sum(loads * np.sin(angles)))

    def radial_for(self, axial):
        """Radial displacement that balances the radial load."""
        load = self.bearing.load
        return _root(lambda radial: self.forces(radial, axial)[0] - load, 0.0, load) if load > 0 else 0.0


def _axial_displacement(bearing, ring):
    """Axial displacement that balances the axial load; without axial load that of a purely radial displacement."""
    if bearing.axial == 0:
        return ring.centred
    lowest = -bearing.groove_distance * math.sin(ring.free) if not bearing.rollers else -_reach(bearing, ring)
    least = ring.forces(ring.radial_for(lowest), lowest)[1]
    if bearing.axial < least:
        raise SceneError(f"bearing.axial = {bearing.axial:g} N is too little for a single row with a contact angle of "
                         f"{bearing.contact_angle:g} deg under a radial load of {bearing.load:g} N; allowed: at least "
                         f"{least:.4g} N, or 0 N for a purely radial displacement")
    return _root(lambda axial: ring.forces(ring.radial_for(axial), axial)[1] - bearing.axial, lowest, bearing.axial)


def _reach(bearing, ring):
    """Upper limit of the axial displacement: a single roller carries the radial load; beyond it the ring has no contact."""
    alone = (bearing.load / (ring.c * math.cos(bearing.alpha))) ** (1 / ring.n)
    return 10 * alone / math.sin(bearing.alpha)


def _root(excess, low, load):
    """Displacement (m) above `low` at which the increasing function `excess` is zero. Raises SceneError."""
    high = low + FIRST
    while excess(high) < 0:
        if high - low > FARTHEST:
            raise SceneError(f"a load of {load:g} N is beyond what this bearing can carry elastically; allowed: less load")
        high = low + 2 * (high - low)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    return high
