"""Largest height that features reach together, where they overlap or meet."""

import functools
import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.scales import Scales

ALONG, ACROSS = 129, 17  # points over each feature; the one in the middle is the top of a single bump
WIDEST = 8.0  # a: distance over which a feature without ends is sampled
MOST = 32  # features over which this is looked for, those in front that may reach most; of each feature the middle is looked at


def height_at(features, x, y):
    """Height (m) of all these features together at x, y (m, arrays that broadcast) on their surface."""
    return sum(f.height_at(x - f.x, y - f.y) for f in features)


@dataclass(frozen=True)
class Pass:
    """Rectangle of positions `at` (m) of the first feature and y (m) in which a feature passes the place x (m).

    pace: of its surface, over that of the first feature; 0 at rest. far: m, over which a feature without ends is sampled.
    """

    feature: Feature
    x: float
    pace: float
    far: float

    @functools.cached_property
    def along(self):
        """(centre, half the length) along `at`; the length is infinite at rest, or -1 where that does not reach x."""
        beside, reach = self.x - self.feature.x, self.feature.reach
        return (beside / self.pace, reach / abs(self.pace)) if self.pace else (0.0, math.inf if abs(beside) <= reach else -1.0)

    @functools.cached_property
    def across(self):
        """(centre, half the length) along y; infinite of a transverse feature."""
        return self.feature.y, self.feature.reach_y or math.inf

    def points(self):
        """Points (n, 1) of `at` and (m,) of y over the rectangle."""
        sides = (self.along, self.far / (abs(self.pace) or 1.0), ALONG), (self.across, self.far, ACROSS)
        at, y = (np.linspace(centre - min(half, far), centre + min(half, far), count) for (centre, half), far, count in sides)
        return at[:, None], y

    def height(self, at, y):
        """Height (m) of the feature at x."""
        return self.feature.height_at(self.x - self.pace * at - self.feature.x, y - self.feature.y)


def highest_at(scene, X, room):
    """Largest height (m) at X (a) of all features together while they pass it, at least that of the highest one. Not above
    `room` (m) it may be that of the highest one alone.
    """
    a = Scales.of(scene).a
    return _highest([Pass(f, X * a, 0.0 if s.stands else s.pace, WIDEST * a) for s in scene.surfaces for f in s.features], room)


def highest_on(features, a):
    """Largest height (m) of these features of one surface together; a: half-width of the contact, m."""
    return _highest([Pass(f, 0.0, 1.0, WIDEST * a) for f in features])


def _highest(passes, room=0.0):
    """Largest sum of heights over the rectangles of all passes, each with those that it meets."""
    alone = max([0.0, *(one.feature.top for one in passes)])
    if _most(passes) <= max(room, alone):
        return alone
    met = _meetings(passes)
    near = [[passes[n] for n in np.flatnonzero(row)] for row in met]
    highest = max(alone, _in_the_middles(passes, met))
    for one, some in sorted(zip(passes, near), key=lambda pair: -_most(pair[1]))[:MOST]:
        if _most(some) > max(highest, room):
            highest = max(highest, _sum(some, *one.points()))
    return highest


def _most(passes):
    """Height (m) that these passes do not exceed together."""
    return sum(one.feature.top for one in passes if one.feature.top > 0)


def _meetings(passes):
    """Mask (n, n): whether the rectangles of two passes have points in common."""
    along, across = (_overlaps(*np.array(sides).T) for sides in zip(*((one.along, one.across) for one in passes)))
    return along & across


def _overlaps(centre, half):
    """Mask (n, n): whether two intervals (centre, half the length, negative for none) have points in common."""
    apart = np.abs(np.subtract.outer(centre, centre))
    return (np.minimum.outer(half, half) >= 0) & (apart <= np.add.outer(half, half))


def _in_the_middles(passes, met):
    """Largest height (m) in the middle of a rectangle, of the passes that meet there."""
    at, y = (np.array([side[0] for side in sides]) for sides in zip(*((one.along, one.across) for one in passes)))
    return float(np.max(sum(np.where(mask, one.height(at, y), 0.0) for one, mask in zip(passes, met))))


def _sum(passes, at, y):
    """Largest height (m) of these passes together at some points."""
    return float(np.max(sum(one.height(at, y) for one in passes)))
