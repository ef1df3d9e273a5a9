"""Worst points at the rim of a measured map, and points of it that do not pass: what is said of them."""

from types import SimpleNamespace

import numpy as np
import pytest
from made_results import fatigue
from map_feature import feature

from tehl_taichi.report import surface_plots
from tehl_taichi.runs.summary import result_warnings, rim_warnings
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.surface.maps import map_warnings

HALF = {"x": 150e-6, "y": 100e-6}  # m, of the patch


def store(folder, **keys):
    """Of a scan of 401 x 301 points 1 um apart, its middle of 300 x 200 um used, taper 40 um."""
    np.save(folder / "scan.npy", np.random.default_rng(1).normal(0, 0.01, (301, 401)))
    keys = {"extent_x": 2 * HALF["x"], "extent_y": 2 * HALF["y"], "taper": 40e-6, **keys}
    f = feature(folder / "scan.npy", **keys)
    return SimpleNamespace(scene=scene("gear").replace(feature=[{key: getattr(f, key) for key in (
        "shape", "file", "unit", "pixel", "taper", "extent_x", "extent_y", "x", "y")}]))


def said(of, x=0.0, y=0.0, **parts):
    return list(rim_warnings.rims(of, {"fatigue": {**fatigue(), "x_m": x, "y_m": y, "below": {}, **parts}}))


def test_a_point_is_at_the_rim_of_a_map_on_its_own_body(tmp_path):
    """Body b, which decides, slides over the map: a place on it says nothing about the rim; that of body a is told."""
    at_rim = {**fatigue(), "x_m": 0.0, "y_m": 64e-6, "below": {}}
    of, both = store(tmp_path), {name: {**at_rim, "surface": name} for name in "ba"}
    told = list(rim_warnings.rims(of, {"fatigue": both["b"], "fatigue_by_surface": both}))
    assert len(told) == 1 and told[0].startswith("the critical point at surface a lies 36 um inside the rim")
    assert list(rim_warnings.rims(of, {"fatigue": both["b"], "fatigue_by_surface": {"b": both["b"]}})) == []


@pytest.mark.parametrize("x, y, words", [
    (0.0, 64e-6, "36 um inside the rim along which the scan ends, within its taper of 40 um"),
    (0.0, -103e-6, "3 um outside the rim along which the scan ends, after a taper of 40 um"),
    (-130e-6, 0.0, "20 um inside the rim"),
    (0.0, 59e-6, None), (-109e-6, 0.0, None), (0.0, 150e-6, None)])
def test_a_worst_point_in_the_taper_is_doubted(tmp_path, x, y, words):
    found = said(store(tmp_path), x, y)
    assert len(found) == (words is not None)
    if words:
        axis, size = ("y", "0.3") if y else ("x", "0.4")
        assert found[0].startswith(f"the critical point at the surface lies {words}")
        assert f"a larger feature.extent_{axis} moves the rim away (the file has {size} mm)" in found[0]


def test_a_cut_edge_without_a_taper_is_a_step(tmp_path):
    cut = store(tmp_path, taper=0.0)
    sentence, = said(cut, 0.0, HALF["y"] - 1e-6)
    assert "1 um inside the rim along which the scan ends, in a step, without a taper: its index may be caused by" in sentence
    assert said(cut, 0.0, 60e-6) == []
    whole = store(tmp_path, extent_x=0.0, extent_y=0.0)
    assert "the file ends there; use a scan that is longer along y" in said(whole, 0.0, 140e-6)[0]


def test_places_are_those_of_the_map_and_told_once(tmp_path):
    moved = store(tmp_path, y=50e-6)
    assert said(moved, 0.0, 64e-6) == [] and len(said(moved, 0.0, -20e-6)) == 1
    at = {"x_m": 0.0, "y_m": 70e-6}
    below, part = {**at, "depth_m": 9e-6}, {"to_x_a": 0.1, "x_m": 0.0, "y_m": 0.0, "below": at}
    found = said(store(tmp_path), 0.0, 0.0, below=below, resolved=part)
    assert [one.partition(" lies ")[0] for one in found] == ["the critical point below the surface of the resolved part"]
    assert rim_warnings.rims in result_warnings.CHECKS and said(SimpleNamespace(scene=scene("gear")), 0.0, 1e-4) == []


def test_only_points_that_are_used_count_as_not_measured(tmp_path):
    heights = np.random.default_rng(1).normal(0, 0.01, (101, 101))
    heights[:3, :3] = heights[50, 50:52] = np.nan
    np.save(tmp_path / "holed.npy", heights)
    cut, whole = (feature(tmp_path / "holed.npy", **keys) for keys in ({"extent_x": 50e-6, "extent_y": 60e-6}, {}))
    assert "2 of its 3111 used points were not measured" in next(map_warnings._holes(cut))
    assert "11 of its 10201 points were not measured" in next(map_warnings._holes(whole))
    assert ("not measured", "2, filled in (11 in the whole file)") in surface_plots.map_facts(cut, scene("gear"))
    away = feature(tmp_path / "holed.npy", extent_x=50e-6, extent_y=60e-6, x=0.0)
    assert away.to_rim(20e-6, -31e-6) == pytest.approx((5e-6, -1e-6))


def test_near_is_by_the_longer_side_of_a_cell(tmp_path):
    coarse = store(tmp_path, taper=0.0)
    coarse.scene = coarse.scene.replace(**{"grid.nx": 256, "grid.ny": 16})
    dx, dy = Scales.of(coarse.scene).cell(coarse.scene.grid)
    assert dy > 1.5 * dx and len(said(coarse, 0.0, HALF["y"] - 1.9 * dy)) == 1


def test_the_advice_is_that_of_the_axis_along_which_the_rim_is_near(tmp_path):
    """A patch that is as long as its file along y alone."""
    long = store(tmp_path, extent_y=0.0)
    assert "the file ends there; use a scan that is longer along y" in said(long, 0.0, 140e-6)[0]
    assert "a larger feature.extent_x" in said(long, 145e-6, 0.0)[0]
