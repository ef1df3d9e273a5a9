"""Windows that overlap: which one a node belongs to."""

import dataclasses

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.march.zoom import overlap
from tehl_taichi.march.zoom.overlap import PlacedWindow
from tehl_taichi.march.zoom.window import HALF, windows_of
from tehl_taichi.scene.scales import Scales

GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "grid.nx": 128, "grid.ny": 32, "zoom.factor": 4})
FIRST = GEAR.features[0]


def of_both(scene=GEAR, **changes):
    """The scene with a second feature on body b."""
    other = dataclasses.replace(FIRST, surface="b", height=-1e-6, **changes)
    return dataclasses.replace(scene, features=(FIRST, other))


def placed(scene, X):
    return [PlacedWindow.of(window, X) for window in windows_of(scene, 4)]


def whole(scene):
    """Numbers of all fine columns and rows."""
    w = windows_of(scene, 4)[0]
    return np.arange(w.all_nx + 1), np.arange(w.all_ny + 1)


@pytest.mark.parametrize("srr", [0.12, -0.3])
@pytest.mark.parametrize("X", [-1.2, 0.0, 0.9, 1.45])
def test_the_weights_of_two_windows_are_those_of_their_union(srr, X):
    scene = of_both(GEAR.replace(srr=srr), x=-1e-4)
    (first, second), nodes = placed(scene, X), whole(scene)
    one, two = overlap.weight(first, [second], *nodes), overlap.weight(second, [first], *nodes)
    c, d = first.core(*nodes), second.core(*nodes)
    assert np.allclose(one + two, c + d - c * d) and min(one.min(), two.min()) >= 0
    assert np.array_equal(one[:, d[0] == 0], c[:, d[0] == 0]) and np.array_equal(overlap.weight(first, [], *nodes), c)


@pytest.mark.parametrize("X", [-1.2, 0.0, 0.9, 1.45])
def test_each_feature_belongs_to_the_window_that_moves_with_it(X):
    """Also at the end of the grid, where the first window stays and the other feature enters it."""
    scene = of_both(GEAR.replace(srr=0.3), x=-1.5e-4)
    a, windows, nodes = Scales.of(scene).a, placed(scene, X), whole(scene)
    for own, surface in zip(windows, scene.surfaces):
        at = surface.pace * X + surface.features[0].x / a
        column = round((at - own.window.x_min) / own.window.dx)
        if column > nodes[0][-1]:
            continue
        other, = (one for one in windows if one is not own)
        apart = abs(own.at - other.at) * own.window.dx > 0.5
        assert overlap.weight(own, [other], *nodes)[0, column] > (0.9 if apart else 0.5)
        inside = overlap.inside(own, [other])
        assert inside[0, column - own.origin]


@pytest.mark.parametrize("X", [-1.2, 0.0, 0.9, 1.45])
def test_no_node_of_a_window_is_without_one(X):
    scene = of_both(GEAR.replace(srr=0.3), x=-1.5e-4)
    windows, (columns, rows) = placed(scene, X), whole(scene)
    of_one, found = np.zeros((rows.size, columns.size), bool), np.zeros((rows.size, columns.size), int)
    for own in windows:
        w = own.window
        part = np.s_[w.row : w.row + w.ny + 1, own.origin : own.origin + w.nx + 1]
        of_one[part] |= w.inside(own.origin)
        found[part] += overlap.inside(own, [one for one in windows if one is not own])
    assert np.array_equal(found > 0, of_one) and (found > 1).sum() < 0.01 * of_one.sum() + 2 * rows.size
    assert np.array_equal(~overlap.outside(windows), of_one[::4, ::4])
    core = np.maximum(*(one.core(columns, rows) for one in windows))
    assert np.array_equal(core >= HALF, of_one)


def test_a_window_is_where_its_store_says():
    """By the number of its first column: half-way between two columns, the position of the feature in m and back rounds."""
    (window, *_) = windows_of(tehl.scene("gear"), 4)
    placed = PlacedWindow.of(window, 0.3)
    moved = PlacedWindow.of(window, 0.3, placed.origin + 1)
    assert (moved.origin, moved.at) == (placed.origin + 1, placed.at)


@pytest.mark.parametrize("y", [4e-5, -6e-5])
def test_a_window_off_the_axis_is_nearest_to_its_feature(y):
    """Nearness is 1 in its middle row and 0 at both ends."""
    scene = GEAR.replace(**{"feature.y": y})
    own = PlacedWindow.of(windows_of(scene, 4)[0], 0.0)
    w = own.window
    rows = np.arange(w.row, w.row + w.ny + 1)
    near = own.nearness(np.array([round(own.at)]), rows)[:, 0]
    assert w.y_min + rows[np.argmax(near)] * w.dy == pytest.approx(y / Scales.of(scene).a, abs=3 * w.dy)
    assert near.max() > 0.95 and near[0] == near[-1] == 0
