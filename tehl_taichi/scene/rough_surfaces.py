"""Test for rough surfaces: many peaks pass through the contact, and no single one dominates."""

import numpy as np

from tehl_taichi.scene.overlap import height_at
from tehl_taichi.scene.scales import Scales

PEAKS = 5  # along a line that count as many
HIGH = 0.3  # of the largest height: lower ones are no peaks
POINTS, LINES = 801, 9  # sampled of a surface, along lines of each direction


def is_rough(scene):
    """Whether a surface has at least PEAKS peaks or pits along a line in rolling direction or across it."""
    return any(_peaks(scene, surface.features) >= PEAKS for surface in scene.surfaces if surface.features)


def _peaks(scene, features):
    """Largest number of peaks along a line of a surface."""
    s, first = Scales.of(scene), features[0]
    wide = scene.grid.y_max * s.b if np.isfinite(s.b) else scene.grid.y_max * s.a
    reach = [f.reach for f in features if np.isfinite(f.reach)]
    ends = [(f.x - first.x - r, f.x - first.x + r) for f, r in zip(features, reach)] or [(-s.a, s.a)]
    x = np.linspace(min(low for low, _ in ends), max(high for _, high in ends), POINTS)
    y, lines = (np.linspace(-wide, wide, count) - first.y for count in (POINTS, LINES))
    along = height_at(features, x[:, None] + first.x, lines[None] + first.y)
    across = height_at(features, np.linspace(x[0], x[-1], LINES)[None] + first.x, y[:, None] + first.y)
    return max(_most(np.abs(heights)) for heights in (along, across))


def _most(heights):
    """Largest number of peaks (points above both neighbours) in a column."""
    inner = heights[1:-1]
    tops = (inner > heights[:-2]) & (inner >= heights[2:]) & (inner > HIGH * heights.max())
    return int(tops.sum(axis=0).max())
