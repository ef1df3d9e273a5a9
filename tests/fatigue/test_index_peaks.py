"""The worst places of a surface, and the table and numbers that reports have of them."""

import made_results
import numpy as np
import pytest
from made_results import THERMAL
from read_pages import page

from tehl_taichi.fatigue.index_peaks import around, worst_places

X, Y = np.linspace(-2, 2, 81), np.linspace(-1, 1, 41)


def bumps(*places):
    """Index with a bump of each (x, y, height)."""
    return sum(height * np.exp(-((X[:, None] - x) ** 2 + (Y - y) ** 2) / 0.02) for x, y, height in places)


def test_the_largest_come_first_and_apart():
    index = bumps((-1.0, 0.5, 1.0), (1.0, -0.5, 3.0), (1.35, -0.5, 2.0), (0.0, 0.0, 2.5))
    found = worst_places(X, Y, index, 0.5, 8)
    assert [(round(X[i], 2), round(Y[j], 2)) for i, j in found[:3]] == [(1.0, -0.5), (0.0, 0.0), (-1.0, 0.5)]
    assert len(worst_places(X, Y, index, 0.5, 2)) == 2
    assert (round(X[worst_places(X, Y, index, 0.3, 8)[2][0]], 2)) == 1.35  # no shoulder of the larger one


@pytest.mark.parametrize("apart, count", [(0.5, 4), (0.75, 2), (1.6, 1)])
def test_distances_along_x_and_y_count_alike(apart, count):
    """Bumps 0.7 apart in a square; a surface with exchanged axes has the exchanged places."""
    index = bumps((-0.35, -0.35, 1.0), (-0.35, 0.35, 0.9), (0.35, -0.35, 0.8), (0.35, 0.35, 0.7))
    found = worst_places(X, Y, index, apart, 8)
    assert len(found) == count and found[0] == (33, 13)
    assert worst_places(Y, X, index.T, apart, 8) == [(j, i) for i, j in found]


def test_a_slope_is_no_place_but_an_edge_is():
    assert worst_places(X, Y, X[:, None] + 0.1 * Y, 0.1, 8) == [(80, 40)]


def test_the_largest_around_a_place():
    index = bumps((1.0, -0.5, 3.0))
    assert around(X, Y, index, (58, 10), 0.15) == pytest.approx(3.0) and around(X, Y, index, (58, 10), 0.05) < 3.0


def searched(scene, tmp_path):
    maps = made_results.maps(41, 21)
    x, y = maps["feature_frame_x"][0], maps["feature_frame_y"][0]
    Fi = sum(height * np.exp(-((x[:, None] - at) ** 2 + (y - across) ** 2) / 1e-10)
             for at, across, height in ((5e-5, 5e-5, 1.2), (-5e-5, 2e-5, 1.1)))
    maps |= {"Fi": (Fi, ["x", "y"], "1", "Fi"), "worst_depth": (np.array([3e-6]), ["d"], "m", "depth"),
             "findley_stress_at_worst_depth": (4e8 * Fi[::-1], ["x", "y"], "Pa", "stress")}
    return page(made_results.run(tmp_path / "a.zarr", scene, search=made_results.fatigue(1.2), found=maps), tmp_path)


@pytest.fixture
def rendered():
    pytest.importorskip("plotly")
    pytest.importorskip("jinja2")


def test_reports_number_the_places_of_a_rough_surface(rendered, tmp_path):
    rough = {"shape": "rough", "height": 1e-7, "width": 200e-6, "extent_x": 200e-6, "extent_y": 200e-6}
    seen = searched(THERMAL.replace(feature=[rough]), tmp_path)
    assert "Points of the feature with the largest index" in seen.text and "Fi 3 µm below" in seen.text
    numbers, = [trace for trace in seen.figures["index-surface"]["data"] if trace.get("mode") == "text"]
    assert numbers["text"] == ["1", "2"] and sorted(numbers["x"]) == pytest.approx([-50.0, 50.0])
    assert "1.20" in seen.text and "1.10" in seen.text


def test_a_single_asperity_needs_no_table(rendered, tmp_path):
    seen = searched(THERMAL, tmp_path)
    assert "with the largest index, numbered" not in seen.text
    assert not [trace for trace in seen.figures["index-surface"]["data"] if trace.get("mode") == "text"]
