"""Places that a report numbers on its maps."""

from types import SimpleNamespace

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.report import numbered_points
from tehl_taichi.scene.scales import Scales


def test_the_worst_place_is_that_of_the_larger_index_at_either_depth():
    """One at the surface and a worse one below; a peak beside that, too near for a place of its own, too far for its value."""
    scene = tehl.scene("rough")
    side = np.linspace(-1, 1, 81) * Scales.of(scene).a
    top, deep = np.full((81, 81), 0.1), np.full((81, 81), 0.1)
    top[20, 20], deep[60, 60], top[60, 67] = 0.8, 1.5, 0.6
    assert numbered_points.APART / 2 < 7 / 40 < numbered_points.APART
    result = SimpleNamespace(Fi=top, feature_frame_x=side, feature_frame_y=side, worst_depth=[1e-5], index=lambda name: deep)
    first, second = numbered_points.places(SimpleNamespace(result=result, scene=scene))[:2]
    assert (first.x, first.y) == pytest.approx((side[60], side[60]))
    assert (first.Fi, first.below) == (0.1, 1.5) and (second.Fi, second.below) == (0.8, 0.1)
