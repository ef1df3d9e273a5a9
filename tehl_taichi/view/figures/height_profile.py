"""Heights that pass through the contact: all features together, around the centre of the first."""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.scene.overlap import height_at
from tehl_taichi.scene.scales import Scales

EVEN = 399     # points of a mesh along x and y; odd: one stands in the middle
ALONG = 1999   # of a line
LONG = 4.0     # length over width, either way, beyond which x and y have scales of their own
AROUND = 0.05  # of what is covered, shown on each side of it: the smooth surface around a feature


@dataclass(frozen=True)
class Heights:
    """x, y: m, from the first feature's centre and from the middle of the contact, as in maps of the index; values (x, y): m,
    one row if nothing varies along y; filled (x, y): mask of unmeasured points that are filled from their neighbours.
    """

    x: np.ndarray
    y: np.ndarray
    values: np.ndarray
    filled: np.ndarray

    @property
    def line(self):
        return self.y.size == 1

    @property
    def tall(self):
        """Width over length."""
        return float(np.ptp(self.y) / np.ptp(self.x))

    @property
    def true(self):
        """Whether x and y can have one scale."""
        return 1 / LONG < self.tall < LONG


def heights(scene):
    """The :class:`Heights` of a scene with a passage; a single map on its own points."""
    features = scene.features
    if all(f.transverse for f in features):
        x, y = _even(features, "x", ALONG), np.zeros(1)
    elif len(features) == 1 and features[0].kind.measured and min(features[0].points) > 1:
        x, y = _own(features[0])
    else:
        edge = scene.grid.y_max * Scales.of(scene).b
        x, y = _even(features, "x", EVEN), _even([f for f in features if not f.transverse], "y", EVEN, edge)
    filled = sum(f.kind.filled(f, x[:, None] - f.x, y - f.y) for f in features) > 0
    return Heights(x, y, height_at(features, x[:, None], y), filled)


def _own(f):
    """Points of a map inside its patch."""
    sides = []
    for count, step, size, at in zip(f.whole_heights.shape[::-1], f.steps, f.patch, (f.x, f.y)):
        points = (np.arange(count) - (count - 1) / 2) * step
        inside = np.abs(points) <= size / 2 * (1 + 1e-9)
        sides.append(np.clip(points[inside], -size / 2, size / 2) + at)  # rounding must not cut the rim off
    return sides


def _even(features, axis, count, edge=math.inf):
    """Evenly spaced points over the features along an axis, within the domain."""
    reach = [(getattr(f, axis), f.reach if axis == "x" else f.reach_y) for f in features]
    low, high = min(at - r for at, r in reach), max(at + r for at, r in reach)
    more = AROUND * (high - low) if math.isfinite(high - low) else 0.0
    return np.linspace(max(low - more, -edge), min(high + more, edge), count)
