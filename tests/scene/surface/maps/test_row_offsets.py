"""Offsets of rows: found in stitched maps and scans of single lines, not in roughness of any lay; removed by level = rows."""

import dataclasses

import numpy as np
import pytest
from map_feature import feature
from scene.surface.maps.test_outliers import surface

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import scene
from tehl_taichi.scene.surface.maps import row_offsets


@pytest.mark.parametrize("across, along", [(2, 40), (40, 2), (200, 2), (1000, 3), (5, 5), (12, 12), (1, 1)])
def test_roughness_has_none(across, along):
    """across, along: points over which heights are alike along a row and from row to row."""
    assert [row_offsets.find(surface(seed=seed, across=across, along=along)) for seed in range(12)] == [None] * 12


def test_each_row_by_itself():
    heights = surface(across=6, along=6) + 0.5e-6 * np.random.default_rng(1).standard_normal((90, 1))
    found = row_offsets.find(heights)
    assert found.rows == 0 and found.size == pytest.approx(0.5e-6 * np.sqrt(2), rel=0.3)
    assert row_offsets.without_offsets(heights).std() < 1.05 * surface().std()


def test_stitches():
    heights = surface()
    heights[30:] += 1e-6
    heights[70:] -= 0.8e-6
    found = row_offsets.find(heights)
    assert found.rows == 2 and found.size == pytest.approx(1e-6, rel=0.3)


@pytest.mark.parametrize("transpose", [False, True])
def test_they_are_reported_and_removed_on_request(tmp_path, transpose):
    clean = 1e6 * surface()
    offset = np.random.default_rng(1).standard_normal((90, 1))
    np.save(tmp_path / "scan.npy", clean + offset)
    np.save(tmp_path / "clean.npy", clean)
    f, even, other = (feature(tmp_path / f"{name}.npy", transpose=transpose, level=level, pixel=8e-6) for name, level in
                      (("scan", "plane"), ("scan", "rows"), ("clean", "rows")))
    np.testing.assert_allclose(even.whole_heights, other.whole_heights, atol=1e-15)
    said = [[one for one in dataclasses.replace(scene("gear"), features=(each,)).warnings() if "level = 'rows'" in one]
            for each in (f, even, other)]
    assert [len(each) for each in said] == [1, 0, 0] and "the rows of the file are offset by about" in said[0][0]
    assert f.unfaded.rms > 2 * even.unfaded.rms


def test_a_profile_has_no_rows(tmp_path):
    np.save(tmp_path / "a.npy", np.arange(20.0))
    with pytest.raises(SceneError, match="feature.level = 'rows' needs shape = 'map'"):
        feature(tmp_path / "a.npy", shape="profile", level="rows")
