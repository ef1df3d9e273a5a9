"""The part of the gap that features fill."""

import numpy as np


def smooth_with(levels, features):
    """The undeformed gap (ny+1, nx+1) with features of surfaces at rest in it."""
    gap = levels.smooth_gap()
    if features:
        gap = gap.copy()
        for feature in features:
            take_off(gap, levels, feature, 0.0)
    return gap


def with_features(gap, levels, surfaces, X):
    """A copy of the gap (ny+1, nx+1) with the features of both surfaces in it; X: way of the first one, a."""
    gap = gap.copy()
    for surface in surfaces:
        for feature in surface.features:
            take_off(gap, levels, feature, surface.pace * X)
    return gap


def sink(gap, levels, surfaces, changes, X):
    """Add to the gap what plastic flow took from the surfaces; changes: each a
    :class:`tehl_taichi.plastic.surface_change.SurfaceChange`; X: way of the first feature, a."""
    s, paces = levels.scales, {surface.name: surface.pace for surface in surfaces}
    for change in changes:
        gap += change.at((levels.X - paces[change.surface] * X) * s.a, levels.Y * s.a) / s.h


def take_off(gap, levels, feature, at):
    """Take the heights of a feature off the gap; at: how far its surface has moved, a."""
    s = levels.scales
    x, y = (levels.X - at) * s.a - feature.x, levels.Y[:, None] * s.a - feature.y
    under = np.abs(x) <= feature.reach
    if feature.transverse:  # cheap, and a ridge does not quite end
        under, y = slice(None), y[:1]
    gap[:, under] -= feature.height_at(x[under], y) / s.h
