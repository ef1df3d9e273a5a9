"""The low-pass of measured maps: transmission of ISO 16610-61, its place in the surface, what tells of it."""

import dataclasses

import numpy as np
import pytest
from map_feature import feature

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.report import surface_plots
from tehl_taichi.scene import scene
from tehl_taichi.scene.scene_warnings import doubtful_features
from tehl_taichi.scene.surface.maps import gaussian_filter

CUTOFF = 25e-6
STEPS = {"pixel": 2e-6, "pixel_y": 2.5e-6}


def waves(tmp_path, length, axis, tilt=0.0):
    """Whole waves of that length (m) along x (axis 0) or y (1), on a plane of that slope; heights in um."""
    at = np.stack(np.meshgrid((np.arange(301) - 150) * 2e-6, (np.arange(241) - 120) * 2.5e-6))
    np.save(tmp_path / "waves.npy", 0.2 * np.cos(2 * np.pi * at[axis] / length) + 1e6 * tilt * (at[0] - 2 * at[1]))
    return tmp_path / "waves.npy"


@pytest.mark.parametrize("times, share", [(1.0, 0.5), (3.0, 0.926), (1 / 3, 0.002)])
@pytest.mark.parametrize("axis", [0, 1])
def test_waves_pass_as_the_standard_says(tmp_path, times, share, axis):
    """exp(-pi (alpha cutoff/wavelength)^2), on points that lie closer along x than along y."""
    file = waves(tmp_path, times * CUTOFF, axis)
    plain, found = (feature(file, **STEPS, level="none", cutoff=cutoff) for cutoff in (0.0, CUTOFF))
    inside = np.s_[40:-40, 40:-40]
    crest = np.s_[120, 150]
    assert found.whole_heights[crest] / plain.whole_heights[crest] == pytest.approx(share, abs=1e-3)
    np.testing.assert_allclose(found.whole_heights[inside], share * plain.whole_heights[inside], atol=1e-3 * 0.2e-6)


def test_a_plane_is_kept_up_to_the_rim(tmp_path):
    tilted = feature(waves(tmp_path, CUTOFF, 0, tilt=0.01), **STEPS, level="none", cutoff=CUTOFF)
    flat = feature(waves(tmp_path, CUTOFF, 0), **STEPS, level="none", cutoff=CUTOFF)
    x, y = (np.arange(301) - 150) * 2e-6, (np.arange(241) - 120)[:, None] * 2.5e-6
    np.testing.assert_allclose(tilted.whole_heights - flat.whole_heights, 0.01 * (x - 2 * y), atol=1e-14)


def test_at_the_rim_the_mean_is_of_the_points_there_are():
    values = np.random.default_rng(0).normal(size=(9, 14))
    found = gaussian_filter.lowpass(values, (2.0, 3.0), 8.0)
    j, i = np.mgrid[:9, :14]
    for row, column in ((0, 0), (4, 7), (8, 13), (0, 6)):
        weights = np.exp(-np.pi * (((i - column) * 2.0) ** 2 + ((j - row) * 3.0) ** 2) / (0.46972 * 8.0) ** 2)
        assert found[row, column] == pytest.approx((weights * values).sum() / weights.sum(), rel=1e-4)


def test_a_filtered_scan_is_turned_like_any(tmp_path):
    values = np.random.default_rng(2).normal(size=(40, 31)).cumsum(axis=1) * 0.01
    np.save(tmp_path / "scan.npy", values)
    np.save(tmp_path / "hand.npy", values.T[::-1])
    one = feature(tmp_path / "scan.npy", **STEPS, transpose=True, mirror_y=True, cutoff=CUTOFF)
    hand = feature(tmp_path / "hand.npy", pixel=2.5e-6, pixel_y=2e-6, cutoff=CUTOFF)
    np.testing.assert_array_equal(one.whole_heights, hand.whole_heights)
    assert one.measures.rms < 0.9 * feature(tmp_path / "hand.npy", pixel=2.5e-6, pixel_y=2e-6).measures.rms
    assert one.sha256 == feature(tmp_path / "scan.npy", **STEPS).sha256


def test_a_store_has_the_heights_of_the_file_and_filters_them_once(tmp_path):

    from tehl_taichi.store import stored_maps

    f = feature(waves(tmp_path, CUTOFF, 0), **STEPS, cutoff=CUTOFF)
    described = dataclasses.replace(scene("gear"), features=(f,))
    (tmp_path / "a.zarr").mkdir()
    stored_maps.write(tmp_path / "a.zarr", described)
    (tmp_path / "waves.npy").unlink()
    again, = stored_maps.scene_of(tmp_path / "a.zarr", described.to_dict()).features
    assert again == f and again.cutoff == CUTOFF
    np.testing.assert_array_equal(again.whole_heights, f.whole_heights)
    np.testing.assert_array_equal(again.heights, f.heights)


def test_what_was_filtered_is_told(tmp_path):
    f = feature(waves(tmp_path, CUTOFF, 0), **STEPS, cutoff=CUTOFF)
    first, _ = f.kind.preview(f, scene("gear"))
    assert first.endswith("plane removed, low-pass with a cutoff of 25 um (Gaussian)")
    assert ("low-pass", "Gaussian, cutoff 25 µm") in surface_plots.map_facts(f, scene("gear"))
    assert "low-pass" not in dict(surface_plots.map_facts(feature(tmp_path / "waves.npy"), scene("gear")))


@pytest.mark.parametrize("cutoff, words", [(4.9e-6, "at least 5e-06 m"), (0.7e-3, "at most 0.0006 m")])
def test_a_cutoff_that_cannot_be_meant_is_refused(tmp_path, cutoff, words):
    with pytest.raises(SceneError, match=f"feature.cutoff = .*{words}"):
        feature(waves(tmp_path, CUTOFF, 0), **STEPS, cutoff=cutoff)


def test_a_scan_that_the_grid_does_not_carry_is_told_the_cutoff_that_helps(tmp_path):
    """The warnings name a value with which they are gone."""
    heights = 0.2 * np.random.default_rng(4).normal(size=(161, 201))
    np.save(tmp_path / "rough.npy", heights)
    keys = {"shape": "map", "file": str(tmp_path / "rough.npy"), "unit": "um", "pixel": 2e-6, "taper": 20e-6}
    rough = tehl.Scene.from_dict({**scene("gear").to_dict(), "feature": [keys]})
    steep, missed = (said for said in doubtful_features(rough) if "rough.npy" in said)
    assert "slopes up to" in steep and "on this grid the" in missed
    told = {said.split("feature.cutoff = ")[1].split()[0] for said in (steep, missed)}
    assert len(told) == 1
    fixed = rough.replace(**{"feature.cutoff": float(told.pop())})
    assert [said for said in doubtful_features(fixed) if "rough.npy" in said] == []
