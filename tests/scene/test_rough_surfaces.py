"""Peaks of a surface: where they are counted, in which direction, and which are high enough."""

import dataclasses

import numpy as np

import tehl_taichi as tehl
from tehl_taichi.scene import rough_surfaces
from tehl_taichi.scene.scales import Scales

FEATURE = tehl.scene("gear").features[0]


def test_peaks_side_by_side_are_counted_across_rolling():
    """Where no line along it meets more than one."""
    ball = tehl.scene("ball-on-disc")
    a = Scales.of(ball).a
    row = tuple(dataclasses.replace(FEATURE, x=0.0, y=0.2 * n * a, width=0.1 * a, length=0.1 * a) for n in range(-3, 4))
    assert rough_surfaces._peaks(ball, row) == len(row) >= rough_surfaces.PEAKS


def test_the_order_of_features_changes_no_number_of_peaks():
    """The domain ends where it ends, whichever feature comes first; beyond it nothing counts."""
    ball = tehl.scene("ball-on-disc")
    s = Scales.of(ball)
    edge = ball.grid.y_max * s.b
    row = [dataclasses.replace(FEATURE, x=0.0, y=0.3 * n * edge, width=0.1 * s.a, length=0.1 * s.a) for n in range(-3, 6)]
    found = [rough_surfaces._peaks(ball, row[n:] + row[:n]) for n in range(len(row))]
    assert found == [7] * len(row)  # of 0.3 n <= 1


def test_waves_lower_than_a_part_of_the_largest_are_no_peaks():
    heights = np.zeros((101, 1))
    heights[50], heights[10:40:4] = 1.0, 0.9 * rough_surfaces.HIGH
    assert rough_surfaces._most(heights) == 1
    heights[10:40:4] = 1.1 * rough_surfaces.HIGH
    assert rough_surfaces._most(heights) == 9
