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


@pytest.mark.parametrize("x, own", [(-0.41, False), (0.25, False), (0.31, True)])
def test_a_slower_feature_has_been_ahead_of_where_the_passage_ends(x, own):
    """Of a passage that ends in the middle, 1.6 a after its start: it was 0.08 a farther ahead of the window of the faster one,
    and the oil over it is 0.05 a ahead of it (a window of 0.5 a on either side)."""
    s = Scales.of(GEAR)
    wide, narrow = (dataclasses.replace(GEAR.features[0], surface=name, width=width * s.a, x=at * s.a)
                    for name, width, at in (("a", 1.0, 0.0), ("b", 0.2, x)))
    both = dataclasses.replace(GEAR.replace(**{"srr": 0.05, "time.x_end": 0.0}), features=(wide, narrow))
    assert [one.name for one in zoom_room.followed(both)] == ["a", "b"][: 1 + own]
