"""A part of a scan is used as if it were the file: holes, slopes, level and filters are those of the part."""

import dataclasses
import re

import numpy as np
import pytest
from map_feature import feature

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import scene
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.scene_warnings import preview
from tehl_taichi.scene.surface.maps import part_choice

Y, X = np.mgrid[:60, :100] * 1.0
HEIGHTS = 0.2 * np.sin(X / 5) + 0.1 * np.cos(Y / 4) + 1e-4 * X**2 + 0.01 * Y  # um, 1 um apart


@pytest.fixture
def scan(tmp_path):
    np.save(tmp_path / "scan.npy", HEIGHTS)
    return tmp_path / "scan.npy"


PART = {"extent_x": 40e-6, "extent_y": 20e-6, "offset_x": 12e-6, "offset_y": -15e-6, "taper": 4e-6}
CENTRE = (29.5 - 15, 49.5 + 12)  # row, column


@pytest.mark.parametrize("changes", [{}, {"level": "form"}, {"level": "none"}, {"cutoff": 8e-6}])
def test_a_part_is_the_file_that_was_cut_by_hand(scan, tmp_path, changes):
    (row, column), cut = CENTRE, tmp_path / "cut.npy"
    np.save(cut, HEIGHTS[int(row - 10.5) + 1 - 1:int(row + 10.5) + 1, int(column - 20.5):int(column + 20.5) + 1])
    part, hand = feature(scan, **PART, **changes), feature(cut, taper=4e-6, **changes)
    assert part.part.shape == (22, 42) == hand.heights.shape
    np.testing.assert_array_equal(part.whole_heights, hand.whole_heights)
    assert part.unfaded == hand.unfaded and part.form == hand.form


@pytest.mark.parametrize("keys", [{}, {"mirror_x": True}, {"transpose": True}, {"transpose": True, "mirror_y": True}])
def test_the_offset_counts_from_the_centre_of_the_scan_in_the_contact(tmp_path, keys):
    peak = np.zeros((61, 101))
    peak[20, 70] = 0.1
    np.save(tmp_path / "peak.npy", peak)
    keys = {"level": "none", **keys}
    whole = feature(tmp_path / "peak.npy", **keys)
    j, i = np.unravel_index(whole.whole_heights.argmax(), whole.part.shape)
    x, y = ((n - (count - 1) / 2) * 1e-6 for n, count in zip((i, j), whole.points))
    part = feature(tmp_path / "peak.npy", extent_x=16e-6, extent_y=20e-6, offset_x=x, offset_y=y, taper=0.0, **keys)
    assert part.height_at(0.0, 0.0) == pytest.approx(0.1e-6, rel=1e-6)
    assert part.position_in_file(0.0, 0.0) == "row 21, column 71"


def test_holes_and_steep_places_elsewhere_do_not_count(scan, tmp_path):
    heights = HEIGHTS.copy()
    heights[:, :18] = np.nan
    heights[40:, 80:] += 30.0 * (X[40:, 80:] % 2)
    np.save(tmp_path / "a.npy", heights)
    with pytest.raises(SceneError, match="lacks 1080 of its 6000 heights .18 %.*this part has fewer: feature.extent_x = "
                                         "8.1e-05, feature.offset_x = 9e-06"):
        feature(tmp_path / "a.npy")
    with pytest.raises(SceneError, match="slopes of.*set feature.cutoff, or use another part"):
        feature(tmp_path / "a.npy", extent_x=81e-6, offset_x=9e-6)
    np.testing.assert_array_equal(feature(tmp_path / "a.npy", **PART).whole_heights, feature(scan, **PART).whole_heights)
    first, *_ = preview(dataclasses.replace(scene("gear"), features=(feature(tmp_path / "a.npy", **PART),)))
    assert "100 x 60 points 1 um apart, 40 x 20 um of them used around x = 12 um, y = -15 um" in first


@pytest.mark.parametrize("keys, words", [
    ({"offset_x": 31e-6}, "feature.offset_x = 3.1e-05 m moves the part beyond .* at most 2.95e-05 m"),
    ({"offset_y": -20e-6}, "at most 1.95e-05 m"), ({"extent_x": 0.0}, "at most 0 m to each side"),
    ({"cutoff": 30e-6}, "at most 2.1e-05 m")])
def test_a_part_lies_inside_its_file(scan, keys, words):
    with pytest.raises(SceneError, match=words):
        feature(scan, **{**PART, **keys})


@pytest.mark.parametrize("unmeasured", [np.s_[:, :17], np.s_[:, :18], np.s_[:, 83:], np.s_[:9], np.s_[50:, :], np.s_[:, :19]])
@pytest.mark.parametrize("transpose", [False, True])
def test_the_part_that_a_refusal_names_is_whole(tmp_path, unmeasured, transpose):
    """Every point of it is measured, and hardly any other is left out, whether their number is even or odd."""
    heights = HEIGHTS.copy()
    heights[unmeasured] = np.nan
    np.save(tmp_path / "a.npy", heights)
    with pytest.raises(SceneError, match="this part has fewer") as caught:
        feature(tmp_path / "a.npy", transpose=transpose)
    keys = {key: float(value) for key, value in re.findall(r"feature\.(\w+) = ([\d.e-]+\d)", str(caught.value))}
    part = feature(tmp_path / "a.npy", transpose=transpose, taper=4e-6, **keys)
    measured, side = np.isfinite(heights).sum(), max(heights.shape)
    assert keys and not part.holes.any() and measured - side <= part.part.size <= measured


@pytest.mark.parametrize("columns", [100, 101])
@pytest.mark.parametrize("wide", [0.00006, 0.000065, 0.00007])
def test_an_extent_of_whole_points_has_them(columns, wide):
    """Although 7e-5/5e-6 is less than 14 in binary digits."""
    f = Feature.from_heights(1e-8 * np.random.default_rng(1).random((50, columns)), 5e-6, extent_x=wide)
    needed = round(wide / 5e-6) + 1
    assert f.part.shape[1] == needed + (columns - needed) % 2  # as many are left out on both sides


def test_the_part_that_is_proposed():
    holes = np.zeros((50, 80), bool)
    holes[:, :7] = holes[45:] = holes[20, 30] = True
    assert part_choice.measured_part(holes) == (0, 45, 7, 80)
    assert part_choice.measured_part(np.ones((9, 9), bool))[1] <= 9
