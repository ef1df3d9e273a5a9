"""Room for a zoom window across rolling: on either side of the axis, and in ellipses."""

import dataclasses

import pytest

import tehl_taichi as tehl
from tehl_taichi.scene import zoom_room
from tehl_taichi.scene.scales import Scales

GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "grid.nx": 128, "grid.ny": 32})


def reason(scene):
    return zoom_room._no_room_across(scene, scene.reference)


@pytest.mark.parametrize("y, fits", [(1e-4, True), (1.5e-4, True), (2.5e-4, False)])
def test_both_sides_of_the_axis_have_equal_room(y, fits):
    assert [not reason(GEAR.replace(**{"feature.y": side * y})) for side in (1, -1)] == [fits, fits]


@pytest.mark.parametrize("share, fits", [(0.7, True), (1.0, False)])
def test_the_room_across_a_long_ellipse_is_that_of_its_grid(share, fits):
    """In half-widths b, of which one is several a."""
    ball = tehl.scene("ball-bearing").replace(**{"grid.nx": 128, "grid.ny": 256})
    s = Scales.of(ball)
    f = dataclasses.replace(GEAR.features[0], width=0.3 * s.a, length=0.3 * s.a, y=share * ball.grid.y_max * s.b)
    assert s.b > 2 * s.a and (not reason(dataclasses.replace(ball, features=(f,)))) == fits
