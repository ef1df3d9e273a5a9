"""Moments of a passage, counted one by one, and the end of passages with features on both bodies."""

import dataclasses

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.scene import timeline
from tehl_taichi.scene.scales import Scales

GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16, "srr": 0.3})


@pytest.mark.parametrize("steps", [-1, 50])
@pytest.mark.parametrize("every", [1, 7])
@pytest.mark.parametrize("low, high", [(-1.0, 0.99), (-9.0, -1.01), (-0.2, 9.0), (-9.0, 9.0)])
def test_moments_are_the_stored_steps_between_the_ends_of_the_search(steps, every, low, high):
    found = GEAR.replace(**{"time.steps": steps, "output.every": every, "fatigue.from_x": low, "fatigue.to_x": high})
    start, total = found.path[0], timeline.total_steps(found)
    stored = [*range(0, total, every), total]
    at = start + timeline.step_length(found) * np.array(stored)
    count, first, last = timeline.moments(found)
    assert timeline.entries(found) == len(stored) and count == ((low <= at) & (at <= high)).sum()
    assert (first, last) == pytest.approx((at[0], at[-1]))


@pytest.mark.parametrize("srr", [0.3, -0.3])
def test_a_passage_is_over_when_the_last_feature_on_either_body_is_out(srr):
    """Their rear ends move with their surfaces, at the pace that each has against the first one."""
    a = Scales.of(GEAR).a
    pair = [dataclasses.replace(GEAR.features[0], surface=name, x=x * a) for name, x in (("a", 0.0), ("b", -0.2))]
    both = dataclasses.replace(GEAR.replace(srr=srr), features=tuple(pair))
    at = timeline.clear_position(both)
    rear = [surface.pace * at + (f.x - f.reach) / a for surface in both.surfaces for f in surface.features]
    assert len(rear) == 2 and min(rear) == pytest.approx(timeline.LATEST) and max(rear) > 1.2 * timeline.LATEST
