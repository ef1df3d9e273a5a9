"""Entry type of fatigue criteria."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Optional

from tehl_taichi.errors import SceneError
from tehl_taichi.values.registry import Entry

ANGLES = 20001  # of planes; the largest of a smooth function is right to 2e-9
TIED = 1e-9  # relative difference of shear amplitudes that are one


@dataclass(frozen=True, kw_only=True)
class Criterion(Entry):
    """A fatigue criterion.

    value(tau, normal, mean, kappa): stress (Pa) to compare with the fatigue limit; it never decreases with any of the first
    three; for numbers, arrays and in kernels (arithmetic and the functions of `engine.pointwise`).

    tau: shear amplitude of a plane, the radius of the smallest circle around its shear path; normal: its largest normal stress;
    mean: the largest mean stress. chord: tau is half the longest chord of the path. momentary: all three belong to one moment
    (tau: distance from the circle's centre), and the worst moment counts. sheared: the plane is that of the largest tau; of
    planes with equal tau the one with the largest normal stress. convex: the value of an average of stress histories is at most
    the average of their values. sensitivity: text of the stress to which kappa is the
    sensitivity; constants(torsion/bending): (kappa, limit/torsion) at which value is the limit for both fatigue limits, for
    ratios between least and most.
    """

    value: Callable
    sensitivity: str
    constants: Optional[Callable] = None
    least: float = 0.5
    most: float = 1.0
    chord: bool = False
    momentary: bool = False
    sheared: bool = False
    convex: bool = False

    @property
    def falls(self):
        """Whether fewer moments never increase the value; false if they may select another plane or circle centre."""
        return not (self.sheared or self.momentary)

    @property
    def outer(self):
        """Whether moments inside the circle, without the largest normal stress, have no effect."""
        return not (self.chord or self.momentary)

    def from_limits(self, bending, torsion):
        """(kappa, sigma_eF) from the fatigue limits in fully reversed bending and torsion (Pa).

        Raises SceneError if the criterion fits no material with such limits.
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
        """Value (Pa) in uniaxial tension-compression of amplitude S, over all plane angles."""
        np, angles = _planes()
        return self._worst(0.5 * S * np.sin(2 * angles), S * np.cos(angles) ** 2, S / 3, kappa)

    def in_torsion(self, S, kappa):
        """Value (Pa) in pure shear of amplitude S, over all plane angles."""
        np, angles = _planes()
        return self._worst(S * np.abs(np.cos(2 * angles)), S * np.sin(2 * angles), 0.0, kappa)

    def _worst(self, tau, normal, mean, kappa):
        values = self.value(tau, normal, mean, kappa) + 0 * tau
        return float((values[tau >= (1 - TIED) * tau.max()] if self.sheared else values).max())


def _planes():
    """(numpy, angles of the planes); numpy is imported here only, because `tehl --help` lists the criteria."""
    import numpy as np

    return np, np.linspace(0.0, np.pi / 2, ANGLES)
