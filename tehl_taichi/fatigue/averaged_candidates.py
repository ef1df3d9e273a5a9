"""Points whose averaged stress may be the worst, from the stresses at points.

The value of a criterion is convex in the stress history: the radius of the smallest circle around a sum of shear paths is at
most the sum of their radii, the largest normal stress of a sum at most the sum of the largest ones. So the value of an averaged
stress is at most the average of the values at points, and where that average is less than a value that was found, no point can
be worse.
"""

import numpy as np

from tehl_taichi.fatigue.sought import Box
from tehl_taichi.fatigue.stress.averaging import averaged

FIRST = 0.8  # share of the largest average: points with more are searched first
LOW = 1.03  # first planes are so much too low (`NEAR` of findley.py)


class Candidates:
    """Points of the surface of one body, from the SearchResult `found` of its stresses at points.

    reader: the AveragedReader; low: whether `found` may have values of first planes. Values are those of the criterion over
    the limit, as an index.
    """

    def __init__(self, found, reader, low=False):
        self.x, self.y = np.asarray(found.feature_frame_x), np.asarray(found.feature_frame_y)
        self.cell = reader.x[1] - reader.x[0]
        along = averaged(found.findley_stress / found.numbers["sigma_eF_Pa"], reader.along)
        self.most = (LOW if low else 1.0) * averaged(along, reader.across, 1, reader.mirrored)

    def first(self):
        """Box of the points to search first."""
        return self._box(FIRST * self.most.max())

    def wider(self, box, worst):
        """The Box with `box` and all points that may be worse than the index `worst` found in it; None if `box` has all of
        them."""
        other = self._box(min(worst, self.most.max()))
        found = Box(*((min(low, least), max(high, most)) for (low, high), (least, most) in zip(box[:2], other[:2])))
        return None if found == box else found

    def _box(self, least):
        columns, rows = np.nonzero(self.most >= least)
        return Box(*((float(places.min() - self.cell / 2), float(places.max() + self.cell / 2))
                     for places in (self.x[columns], self.y[rows])))
