"""Part of the undeformed gap that belongs to features."""

import numpy as np


def smooth_with(levels, features):
    """Undeformed gap (ny+1, nx+1) with the features of surfaces at rest."""
    gap = levels.smooth_gap()
    if features:
        gap = gap.copy()
        for feature in features:
            subtract(gap, levels, feature, 0.0)
    return gap


def with_features(gap, levels, surfaces, X):
    """Copy of the gap (ny+1, nx+1) with the features of both surfaces; X: displacement of the first one, a."""
    if len(surfaces) > 1 and all(surface.features for surface in surfaces):  # bodies that change places have equal bits
        own, other = (with_features(np.zeros_like(gap), levels, [surface], X) for surface in surfaces)
        return gap + (own + other)
    gap = gap.copy()
    for surface in surfaces:
        for feature in surface.features:
            subtract(gap, levels, feature, surface.pace * X)
    return gap


def sink(gap, levels, surfaces, changes, X):
    """Add the sinking of the surfaces by plastic flow to the gap; changes: each a
    :class:`tehl_taichi.plastic.surface_change.SurfaceChange`; X: displacement of the first feature, a.
    """
    s, paces = levels.scales, {surface.name: surface.pace for surface in surfaces}
    for change in changes:
        gap += change.at((levels.X - paces[change.surface] * X) * s.a, levels.Y * s.a) / s.h


def subtract(gap, levels, feature, at):
    """Subtract the heights of a feature from the gap; at: displacement of its surface, a."""
    s = levels.scales
    x, y = (levels.X - at) * s.a - feature.x, levels.Y[:, None] * s.a - feature.y
    under = np.abs(x) <= feature.reach
    if feature.transverse:  # cheap, and a ridge does not quite end
        under, y = slice(None), y[:1]
    gap[:, under] -= feature.height_at(x[under], y) / s.h
