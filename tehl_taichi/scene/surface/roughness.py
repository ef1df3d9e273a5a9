"""Roughness of heights in standard numbers: ISO 25178-2 of areas, ISO 21920-2 of line profiles."""

import math
from dataclasses import dataclass

import numpy as np

SECTIONS = 5  # of a profile, whose ranges Rz averages
FALLS = 0.2  # of its value at 0: the autocorrelation length is where the autocorrelation function has fallen to that
FARTHEST = 0.5  # of a side: over longer distances too few pairs of points are left


@dataclass(frozen=True)
class Roughness:
    """Sa, Sq, Sz (Ra, Rq, Rz of a profile): mean and rms height about the mean, range (of a profile the mean of five sections),
    m; skewness; slope: rms; lengths: autocorrelation lengths along x and y, m, None if the function does not fall so far.
    """

    Sa: float
    Sq: float
    Sz: float
    skewness: float
    slope: float
    lengths: tuple
    profile: bool = False

    @classmethod
    def of(cls, heights, steps):
        """Roughness of heights (points along y, along x; m); steps: distances (m, along x, along y); a profile has one point
        along an axis.
        """
        z = heights - heights.mean()
        Sq, line = float(np.sqrt(np.mean(z**2))), min(z.shape) == 1
        slopes = [float(np.mean((np.diff(z, axis=axis) / step) ** 2)) for axis, step in zip((1, 0), steps) if z.shape[axis] > 1]
        lengths = tuple(_length(rows, step) for rows, step in zip((z, z.T), steps))
        skewness = float(np.mean(z**3)) / Sq**3 if Sq > 0 else 0.0
        return cls(float(np.abs(z).mean()), Sq, _range(z.ravel()) if line else float(np.ptp(z)), skewness,
                   math.sqrt(sum(slopes)), lengths, line)

    @property
    def words(self):
        letter = "R" if self.profile else "S"
        return ", ".join(f"{letter}{name} {value * 1e6:.3g} um" for name, value in zip("aqz", (self.Sa, self.Sq, self.Sz)))

    def to_dict(self):
        """Numbers with the names and units of a summary."""
        letter = "R" if self.profile else "S"
        lengths = {f"length_{axis}_m": length for axis, length in zip("xy", self.lengths) if length is not None}
        return {f"{letter}a_m": self.Sa, f"{letter}q_m": self.Sq, f"{letter}z_m": self.Sz, "skewness": self.skewness,
                "Rq_slope": self.slope, **lengths}


def _range(profile):
    """Rz: mean of the ranges of equal sections."""
    return float(np.mean([np.ptp(section) for section in np.array_split(profile, SECTIONS)]))


def _length(rows, step):
    """Distance (m) at which the autocorrelation function of the rows has fallen to FALLS; None: nowhere."""
    count = rows.shape[1]
    if count < 3:
        return None
    power = (np.abs(np.fft.rfft(rows, 2 * count)) ** 2).sum(axis=0)
    pairs = np.arange(count, 0, -1) * len(rows)
    function = np.fft.irfft(power, 2 * count)[:count] / pairs
    low = np.flatnonzero(function[: int(FARTHEST * count) + 1] <= FALLS * function[0])
    if not low.size or function[0] <= 0:
        return None
    after = int(low[0])
    before, behind = function[after - 1] / function[0], function[after] / function[0]
    return float((after - 1 + (before - FALLS) / (before - behind)) * step)
