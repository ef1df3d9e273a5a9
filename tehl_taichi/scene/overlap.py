"""Largest height that features reach together, where they overlap or meet."""

import numpy as np

from tehl_taichi.scene.scales import Scales

ALONG, ACROSS = 129, 17  # points over each feature; the one in the middle is the top of a single bump
WIDEST = 8.0  # a: distance over which a feature without ends is sampled


def height_at(features, x, y):
    """Height (m) of all these features together at x, y (m, arrays that broadcast) on their surface."""
    return sum(f.height_at(x - f.x, y - f.y) for f in features)


def highest_at(scene, X, room):
    """Largest height (m) at X (a) of all features together while they pass it, at least that of the highest one. Not above
    `room` (m) it may be that of the highest one alone.
    """
    tops, a = [f.top for f in scene.features], Scales.of(scene).a
    alone = max(tops, default=0.0)
    if sum(top for top in tops if top > 0) <= max(room, alone):
        return alone
    at, y = _positions(scene, X * a, a)[:, None], _points(scene.features, "y", WIDEST * a)
    moved = [(s.features, X * a - (0.0 if s.stands else s.pace) * at) for s in scene.surfaces if s.features]
    return max(alone, float(sum(height_at(features, x, y) for features, x in moved).max()))


def highest_on(features, a):
    """Largest height (m) of these features of one surface together; a: half-width of the contact, m."""
    if not features:
        return 0.0
    x, y = (_points(features, axis, WIDEST * a) for axis in "xy")
    return max(*(f.top for f in features), float(height_at(features, x[:, None], y).max()))


def _positions(scene, x, a):
    """Positions (m) of the first feature at which a feature passes x (m), and one for features at rest."""
    return np.concatenate([[0.0], *((x - _points([f], "x", WIDEST * a)) / s.pace for s, f in scene.passing)])


def _points(features, axis, far):
    """Points (m) over features along an axis; those without ends are sampled over a distance `far` (m)."""
    count = ALONG if axis == "x" else ACROSS
    sides = [(getattr(f, axis), min(f.reach if axis == "x" else f.reach_y, far)) for f in features]
    return np.unique(np.concatenate([np.linspace(at - side, at + side, count) for at, side in sides]))
