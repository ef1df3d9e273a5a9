"""Points on which the passing surface is drawn."""

import dataclasses

import numpy as np
import pytest
from map_feature import feature

import tehl_taichi as tehl
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures import height_profile

GEAR = tehl.scene("gear")


def test_the_mesh_ends_with_the_grid_of_an_ellipse():
    ball = tehl.scene("ball-bearing")
    end = ball.grid.y_max * Scales.of(ball).b
    wide = dataclasses.replace(GEAR.features[0], width=4 * end, length=4 * end)
    found = height_profile.heights(dataclasses.replace(ball, features=(wide, dataclasses.replace(wide, x=1e-4))))
    assert found.y[-1] == pytest.approx(end) and found.y[0] == -found.y[-1]


def test_a_scan_off_the_axis_is_drawn_where_it_lies(tmp_path):
    """A bump at column 30 of 41 and row 20 of 31, points 1 um apart."""
    rows, columns = np.ogrid[:31, :41]
    np.save(tmp_path / "scan.npy", np.exp(-((columns - 30) ** 2 + (rows - 20) ** 2) / 18))
    scan = feature(tmp_path / "scan.npy", x=2e-5, y=5e-6, taper=0.0)
    found = height_profile.heights(dataclasses.replace(GEAR, features=(scan,)))
    column, row = np.unravel_index(np.argmax(found.values), found.values.shape)
    assert (found.x.mean(), found.y.mean()) == pytest.approx((2e-5, 5e-6))
    assert (found.x[column], found.y[row]) == pytest.approx((2e-5 + 10e-6, 5e-6 + 5e-6))
    assert found.values.max() > 0.8e-6
