"""Spikes of a measurement are found, marked as not measured and reported; roughness, steps and scratches are left."""

import dataclasses

import numpy as np
import pytest
from commands import here as tehl
from map_feature import feature

from tehl_taichi.report import surface_plots
from tehl_taichi.scene import scene
from tehl_taichi.scene.scene_warnings import warnings
from tehl_taichi.scene.surface.maps import outliers

STEPS = (2e-6, 3e-6)


def surface(rows=90, columns=120, height=0.3e-6, seed=5, across=6.0, along=6.0):
    """Random heights (m), correlated over so many points along both axes."""
    noise = np.random.default_rng(seed).standard_normal((rows, columns))
    ky, kx = np.fft.fftfreq(rows)[:, None], np.fft.rfftfreq(columns)
    smooth = np.fft.irfft2(np.fft.rfft2(noise) * np.exp(-2 * np.pi * ((kx * across) ** 2 + (ky * along) ** 2)), noise.shape)
    return height * smooth / smooth.std()


def test_every_spike_and_nothing_else_is_found():
    rng = np.random.default_rng(3)
    heights, at = surface(), np.zeros((90, 120), bool)
    at[tuple(rng.integers(0, 90, (2, 40)))] = True
    at[50:52, 60:63] = at[0, 0] = at[-1, 30:33] = True  # groups, a corner, a rim
    heights[at] += rng.choice([-1, 1], at.sum()) * rng.uniform(4e-6, 30e-6, at.sum())
    np.testing.assert_array_equal(outliers.spikes(heights, STEPS), at)
    heights[20:24, 20:24] = np.nan
    found = outliers.spikes(heights, STEPS)
    assert not (found & ~at).any() and (found | np.isnan(heights))[at].all()


@pytest.mark.parametrize("size", [(1, 1), (3, 3), (3, 4), (4, 4)])
def test_a_spike_of_many_points_is_found_with_its_middle(size):
    heights, at = surface(), np.zeros((90, 120), bool)
    at[40:40 + size[0], 60:60 + size[1]] = True
    np.testing.assert_array_equal(outliers.spikes(heights + 6e-6 * at, STEPS), at)


def plateau():
    """Heights above the middle pressed to a tenth: valleys are far from the usual differences."""
    heights = surface(height=0.4e-6, across=2.0, along=20.0)
    return np.where(heights > 0, 0.1 * heights, heights)


def scratched():
    heights = surface()
    heights[40, 10:90] -= 8e-6
    return heights


LEFT = {"rough": surface(height=2e-6, across=2.0, along=2.0), "marks": surface(height=2e-6, across=2.0, along=60.0),
        "plateau": plateau(), "step": surface() + 10e-6 * (np.arange(120) > 50), "scratch": scratched(),
        "noise": 3e-6 * np.random.default_rng(1).standard_normal((90, 120)), "flat": np.zeros((90, 120)),
        "narrow bump": 1e-6 * np.exp(-np.add.outer((np.arange(90) - 40.0) ** 2, (np.arange(120) - 40.0) ** 2) / 8)}


@pytest.mark.parametrize("name", LEFT)
def test_what_is_no_spike_stays(name):
    assert not outliers.spikes(LEFT[name], STEPS).any()


@pytest.mark.parametrize("turned", [False, True])
def test_spikes_of_a_profile(turned):
    profile = surface(rows=1, columns=300)
    profile[0, 100], profile[0, 200] = 9e-6, -7e-6
    found = outliers.spikes(profile.T, (1.0, 2e-6)).T if turned else outliers.spikes(profile, (2e-6, 1.0))
    assert np.argwhere(found).tolist() == [[0, 100], [0, 200]]


@pytest.fixture
def spiked(tmp_path):
    """(file with two spikes, file without them); um."""
    heights = 1e6 * surface()
    np.save(tmp_path / "clean.npy", heights)
    heights[30, 40] += 3.0
    heights[60, 70] -= 9.0
    np.save(tmp_path / "scan.npy", heights)
    return tmp_path / "scan.npy", tmp_path / "clean.npy"


def test_a_spike_does_not_refuse_a_scan(spiked):
    keys = {"pixel": 2e-6, "pixel_y": 3e-6}
    f, clean = (feature(path, **keys) for path in spiked)
    assert f.unfaded.rms == pytest.approx(clean.unfaded.rms, rel=1e-3) and f.unfaded.range < 1.01 * clean.unfaded.range
    assert not np.array_equal(f.heights, clean.heights)  # a store has the heights of the file
    described = dataclasses.replace(scene("gear"), features=(f,))
    said, = (one for one in warnings(described) if "points are spikes" in one)
    assert "2 points" in said and said.endswith("at row 61, column 71") and said.data["spikes"] == 2
    assert said.data["largest_m"] == pytest.approx(9e-6, rel=0.05)
    assert ("not measured", "2, filled in, 2 of them spikes") in surface_plots.map_facts(f, described)
    assert not any("are spikes" in one for one in dataclasses.replace(scene("gear"), features=(clean,)).warnings())
    turned = feature(spiked[0], **keys, transpose=True, mirror_x=True)
    assert turned.place_in_file(*np.argwhere(turned.spikes)[0]) in ("row 31, column 41", "row 61, column 71")


def test_a_scene_is_written_for_a_scan_that_is_too_steep(tmp_path):
    np.savetxt(tmp_path / "a.csv", 1e6 * surface(height=6e-6, across=2.0, along=2.0), delimiter=",")
    done = tehl("new", "a.toml", "--scan", "a.csv", "--unit", "um", "--pixel", "2e-6", cwd=tmp_path)
    assert done.returncode == 0 and "warning: the scene is refused until you change it:" in done.stdout
    assert "slopes of" in done.stdout and "set feature.cutoff" in done.stdout
    file = tmp_path / "a.toml"
    assert tehl("run", "a.toml", "--dry-run", cwd=tmp_path).returncode == 2
    file.write_text(file.read_text().replace("# cutoff = 25e-6", "cutoff = 60e-6"))
    assert tehl("run", "a.toml", "--dry-run", cwd=tmp_path).returncode == 0


@pytest.mark.parametrize("rows, columns, found", [(4, 4, 16), (3, 5, 15), (4, 5, 0), (2, 10, 0)])
def test_a_spike_has_sixteen_points_at_most(rows, columns, found):
    heights = surface()
    heights[40:40 + rows, 50:50 + columns] += 6e-6
    mask = outliers.spikes(heights, (2e-6, 2e-6))
    assert mask.sum() == found == mask[40:40 + rows, 50:50 + columns].sum()
