"""Slip across the contact of a ball and its groove.

The contact surface is curved across rolling, so both bodies have the same speed only along two lines (Heathcote 1921; Johnson,
Contact Mechanics, section 8.5); spin adds to the slip.
"""

from dataclasses import dataclass

import numpy as np

POINTS = 2001
SPINNING = 1e-6  # of the largest slip: the difference of both sides that is spin


@dataclass(frozen=True)
class EllipseSlip:
    """y: across rolling, from -b to b (m); slip: speed of the ring minus that of the element along rolling (m/s); u_m: m/s."""

    y: np.ndarray
    slip: np.ndarray
    u_m: float

    @property
    def weight(self):
        """Share of the Hertz load in each row: proportional to 1 - (y/b)^2."""
        weight = 1 - (self.y / self.y[-1]) ** 2
        return weight / np.sum(weight)

    @property
    def centre(self):
        """Slide-roll ratio at the centre."""
        return float(self.slip[POINTS // 2] / self.u_m)

    @property
    def representative(self):
        """Slide-roll ratio for a run, which has only one: that of the centre, where pressure and features are; with spin, which
        is zero there, the mean absolute slip.
        """
        profile = self.slip - self.slip[::-1]
        return -self.mean / self.u_m if np.any(np.abs(profile) > SPINNING * np.abs(self.slip).max()) else self.centre

    @property
    def edge(self):
        """Largest slide-roll ratio at the ends of the ellipse, with its sign."""
        return float(max(self.slip[0], self.slip[-1], key=abs) / self.u_m)

    @property
    def mean(self):
        """Mean absolute slip (m/s), weighted with the load."""
        return float(np.sum(self.weight * np.abs(self.slip)))

    @property
    def rolling(self):
        """Position y/b > 0 of pure rolling."""
        half = slice(POINTS // 2, None)
        change = np.nonzero(np.diff(np.sign(self.slip[half])))[0]
        return float(self.y[half][change[0]] / self.y[-1]) if change.size else 1.0


def slip_over(contact, b, u_m, spin=0.0):
    """The :class:`EllipseSlip` of a contact (half-axis b across, m) under free rolling; spin: rad/s.

    The profile u (y^2/(2 R_d R_x)) + spin y is exact to second order. Its level follows from the balance of friction with a
    constant coefficient (Coulomb): the load-weighted median is zero. Without spin, pure rolling is at 0.347 b.
    """
    y = np.linspace(-b, b, POINTS)
    profile = u_m * y**2 / (2 * contact.R_d * contact.R_x) + spin * y
    found = EllipseSlip(y, profile, u_m)
    return EllipseSlip(y, profile - weighted_median(profile, found.weight), u_m)


def weighted_median(values, weight):
    """Weighted median: half of the weight lies on either side."""
    order = np.argsort(values)
    below = np.cumsum(weight[order]) - 0.5 * weight[order]
    return float(np.interp(0.5 * np.sum(weight), below, values[order]))
