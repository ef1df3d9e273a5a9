"""The entry of a fatigue criterion."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Optional

from tehl_taichi.errors import SceneError
from tehl_taichi.values.registry import Entry

ANGLES = 20001  # of planes; the largest of a smooth function is right to 2e-9
TIED = 1e-9  # relative difference of shear amplitudes that are one


@dataclass(frozen=True, kw_only=True)
class Criterion(Entry):
    """value(tau, normal, mean, kappa): the stress (Pa) that is compared with the fatigue limit, never smaller where one of the
    first three is larger; for numbers, arrays and in kernels (arithmetic and the functions of `engine.pointwise`).

    tau: shear amplitude of a plane, the radius of the smallest circle around its shear path; normal: its largest normal stress;
    mean: the largest mean stress. With chord: tau is half the longest chord of the path. With momentary: all three are those of
    one moment (tau: distance from the circle's centre), and the worst moment counts. With sheared: the plane is that of the
    largest tau, of planes with the same tau that of the largest normal stress.
    sensitivity: what kappa is the sensitivity to; constants(torsion/bending):
    (kappa, limit/torsion) at which value is the limit for both fatigue limits, for ratios between least and most.
    """

    value: Callable
    sensitivity: str
    constants: Optional[Callable] = None
    least: float = 0.5
    most: float = 1.0
    chord: bool = False
    momentary: bool = False
    sheared: bool = False

    @property
    def falls(self):
        """Whether fewer moments never give more: not where the plane, or the circle's centre, is another one then."""
        return not (self.sheared or self.momentary)

    @property
    def outer(self):
        """Whether moments that lie inside the circle, and have not the largest normal stress, change nothing."""
        return not (self.chord or self.momentary)

    def from_limits(self, bending, torsion):
        """(kappa, sigma_eF) from the fatigue limits in fully reversed bending and torsion (Pa).

        Raises SceneError where the criterion fits no material of such limits.
        """
        if self.constants is None:
            raise SceneError(f"{self.name} cannot derive kappa and sigma_eF from fatigue limits: give kappa and endurance")
        ratio = torsion / bending
        if not self.least < ratio < self.most:
            raise SceneError(f"fatigue limits in bending {bending:g} Pa and torsion {torsion:g} Pa: {self.name} needs a ratio "
                             f"torsion/bending between {self.least:g} and {self.most:g}, not {ratio:.3g}")
        kappa, factor = self.constants(ratio)
        return kappa, torsion * factor

    def in_bending(self, S, kappa):
        """Its stress (Pa) in uniaxial tension and pressure of amplitude S, over planes that turn away from the pull."""
        np, angles = _planes()
        return self._worst(0.5 * S * np.sin(2 * angles), S * np.cos(angles) ** 2, S / 3, kappa)

    def in_torsion(self, S, kappa):
        """Value in pure shear of amplitude S, over planes that turn away from its direction."""
        np, angles = _planes()
        return self._worst(S * np.abs(np.cos(2 * angles)), S * np.sin(2 * angles), 0.0, kappa)

    def _worst(self, tau, normal, mean, kappa):
        values = self.value(tau, normal, mean, kappa) + 0 * tau
        return float((values[tau >= (1 - TIED) * tau.max()] if self.sheared else values).max())


def _planes():
    """numpy (only here: `tehl --help` names the criteria), and the angles of the planes."""
    import numpy as np

    return np, np.linspace(0.0, np.pi / 2, ANGLES)
