"""Where the window of a zoom lies."""

import dataclasses

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.march.zoom.window import Window, given
from tehl_taichi.march.zoom.window_levels import WindowLevels
from tehl_taichi.scene.scales import Scales

GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "grid.nx": 128, "grid.ny": 32})


def along(scene, factor=4, X=0.0):
    """From where to where the window reaches (a) with the first feature at X."""
    w = Window.of(scene, factor)
    return w.columns(w.origin(X))[[0, -1]]


@pytest.mark.parametrize("factor", [2, 4, 8, 16])
def test_the_feature_is_inside_what_the_window_solves(factor):
    w, s = Window.of(GEAR, factor), Scales.of(GEAR)
    reach, ring = GEAR.features[0].reach / s.a, given(factor)
    for X in (-1.0, 0.013, 0.4):
        x = w.columns(w.origin(X))
        assert x[ring] < X - reach and x[-1 - ring] > X + reach
    assert (w.ny - ring) * w.dy > GEAR.features[0].reach_y / s.a
    assert w.nx % 32 == 0 and w.ny % 8 == 0


def test_the_oil_that_passed_over_the_feature_is_inside():
    """Ahead of a slow surface, behind a fast one."""
    rolling = along(GEAR.replace(srr=0.0))
    slow, fast = along(GEAR.replace(srr=-0.3)), along(GEAR.replace(srr=0.3))
    assert slow[1] > rolling[1] + 0.1 and fast[0] < rolling[0] - 0.1


def test_isothermal_oil_has_more_room():
    """It keeps what the inlet made of it beside the feature."""
    w, warm = (Window.of(scene, 16) for scene in (GEAR, GEAR.replace(**{"thermal.on": True})))
    assert 0.2 < (w.nx - warm.nx) * w.dx < 0.4 and 0.1 < (w.back - warm.back) * w.dx < 0.2


def test_it_rides_with_its_surface_by_whole_cells():
    scene = dataclasses.replace(GEAR, features=(dataclasses.replace(GEAR.features[0], surface="b"),))
    w = Window.of(scene, 4)
    assert scene.reference.pace == 1.0  # the first feature is the clock, whichever surface carries it
    origins = [w.origin(X) for X in np.arange(-1.0, 0.5, w.dx)]
    assert set(np.diff(origins)) <= {0, 1, 2} and origins[-1] - origins[0] == round(1.5 / w.dx) - 1


def test_it_stays_on_the_grid():
    w = Window.of(GEAR, 4)
    assert w.origin(-9.0) == 0 and w.origin(9.0) == w.all_nx - w.nx


def test_the_core_is_1_inside_and_0_at_the_border():
    w = Window.of(GEAR, 2)
    origin, rows = w.origin(0.0), np.arange(w.ny + 1)
    core = w.core(np.arange(origin, origin + w.nx + 1), rows, origin)
    ring = given(2)
    assert core.shape == (w.ny + 1, w.nx + 1) and core.max() == 1.0
    assert not core[:, [0, -1]].any() and not core[-1].any() and core[0, w.nx // 2] == 1.0
    assert (core[:, :ring] < 1).all() and w.core([origin - 1, origin + w.nx + 1], [0], origin).max() == 0.0


def test_widths_of_the_user():
    low, high = along(GEAR.replace(**{"zoom.factor": 4, "zoom.width_x": 1.0}), 4)
    assert 1.0 <= high - low < 1.0 + 33 * Window.of(GEAR, 4).dx
    w = Window.of(GEAR.replace(**{"zoom.factor": 4, "zoom.width_y": 1.2}), 4)
    assert 0.6 <= w.ny * w.dy < 0.6 + 9 * w.dy


def test_a_feature_off_the_axis_has_a_window_round_it():
    for y in (4e-5, -6e-5):
        scene = GEAR.replace(**{"feature.y": y})
        w, s = Window.of(scene, 2), Scales.of(scene)
        low, high = (-1.0 + (w.row + n) * w.dy for n in (given(2), w.ny - given(2)))
        assert low < y / s.a - 0.2 and high > y / s.a + 0.2 and w.row > 0


@pytest.mark.parametrize("changes, said", [
    ({"zoom.factor": 3}, "zoom.factor = 3 is not one of 0, 2, 4, 8, 16"),
    ({"zoom.factor": 32}, "zoom.factor = 32 is not one of 0, 2, 4, 8, 16"),
    ({"zoom.factor": 0.5}, "zoom.factor = 0.5 is not one of"), ({"zoom.factor": True}, "zoom.factor = True is not one of"),
    ({"zoom.factor": 2, "output.every": 2}, "needs every step"),
    ({"zoom.factor": 2, "zoom.from_x": 0.5, "zoom.to_x": 0.2}, "must be less than to_x"),
    ({"zoom.factor": 2, "zoom.width_x": 0.01}, "out of range"),
    ({"zoom.factor": 2, "zoom.width_x": 0.3}, "zoom.width_x = 0.3 a is less than the features of surface a; allowed: at least "
                                              "0.552 a"),
    ({"zoom.factor": 2, "zoom.width_y": 0.5}, "zoom.width_y = 0.5 a is less than"),
    ({"zoom.factor": 2, "feature.width": 6e-4, "feature.length": 2e-4}, "extend over 1.66 a along x; allowed: at most 1.5 a"),
    ({"zoom.factor": 2, "feature.length": 6e-4}, "reach to 0.828 a in y; allowed with grid.y_max = 1: at most 0.794 a"),
    ({"zoom.factor": 2, "feature.y": 2.5e-4}, "reach to 0.966 a in y; allowed with grid.y_max = 1: at most 0.794 a")])
def test_what_a_zoom_does_not_take(changes, said):
    with pytest.raises(tehl.SceneError, match=said):
        GEAR.replace(**changes)


def test_a_ridge_across_a_ball_has_no_window():
    with pytest.raises(tehl.SceneError, match="zoom.factor = 4 needs features that end in y, or a line contact"):
        tehl.scene("ridge-on-ball").replace(**{"zoom.factor": 4})


def test_cells_of_the_window_resolve_a_feature():
    """20 um on 128 columns."""
    small = {"feature.width": 2e-5, "feature.height": 3e-7}
    with pytest.raises(tehl.SceneError, match="too few to resolve it"):
        GEAR.replace(**small)
    assert GEAR.replace(**{**small, "zoom.factor": 4}).zooms


def test_the_equations_of_a_window_have_its_cells_also_in_an_ellipse():
    """Whose lengths across are in half-widths b."""
    ball = tehl.scene("ball-bearing").replace(**{"grid.nx": 128, "grid.ny": 256, "thermal.on": False})
    a = Scales.of(ball).a
    feature = dataclasses.replace(GEAR.features[0], width=0.3 * a, length=0.5 * a, height=1e-7)
    scene = dataclasses.replace(ball, features=(feature,)).replace(**{"zoom.factor": 2, "time.steady_only": False})
    w = Window.of(scene, 2)
    levels = WindowLevels(scene, w)
    assert (levels.dx, levels.dy) == pytest.approx((w.dx, w.dy))
