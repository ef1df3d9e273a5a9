"""A scan that was taken from the other side: its mirror image has equal numbers, warnings and spikes."""

import dataclasses

import numpy as np
import pytest

from tehl_taichi.scene import scene
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.scene_warnings import doubtful_features, preview
from tehl_taichi.scene.surface.maps import cutoff_choice, height_map, outliers

STEPS = (2e-6, 3e-6)
MIRRORED = {"x": np.s_[:, ::-1], "y": np.s_[::-1], "x and y": np.s_[::-1, ::-1]}


def rough(shape, seed, rms=0.3e-6, length=3.0):
    """Random heights (rows, columns) with a Gaussian correlation of `length` points."""
    spectrum = np.fft.fft2(np.random.default_rng(seed).standard_normal(shape))
    k = np.add.outer(*(np.fft.fftfreq(count) ** 2 for count in shape))
    heights = np.fft.ifft2(spectrum * np.exp(-k * (np.pi * length) ** 2)).real
    return heights * rms / heights.std()


def passing(heights, taper=30e-6):
    """(feature, scene) of heights in the gear contact."""
    f = Feature.from_heights(heights, *STEPS, taper=taper)
    return f, dataclasses.replace(scene("gear"), features=(f,)).replace(**{"grid.nx": 128, "grid.ny": 32})


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("axes", MIRRORED)
def test_preview_warnings_and_remedies_are_equal(seed, axes):
    """Of sizes that are no whole number of cells, with a hole."""
    heights = rough((83, 131), seed)
    heights[20:23, 40:42] = np.nan
    said, measured = [], []
    for values in (heights, heights[MIRRORED[axes]]):
        f, where = passing(values)
        said.append([*preview(where), *doubtful_features(where)])
        steps = cutoff_choice.points_in_a_cell(f, where)
        measured.append((f.measures.slope, height_map.error_on_grid(f.used, *steps), cutoff_choice.suitable_cutoff(f, where)))
    assert said[0] == said[1] and any("feature.cutoff = " in one for one in said[0])
    assert measured[0] == pytest.approx(measured[1], rel=1e-9) and measured[0][1] > 0.1


@pytest.mark.parametrize("j, i", [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_the_largest_slope_of_a_corner(j, i):
    """One point above a plane: to both sides of it heights fall, whichever corner of a cell it is, at the rim, too."""
    heights = np.zeros((2, 2))
    heights[j, i] = 1e-6
    assert height_map.steepest(heights, STEPS) == pytest.approx(np.hypot(1e-6 / STEPS[0], 1e-6 / STEPS[1]), rel=1e-12)


def test_the_largest_slope_of_a_line_is_that_of_its_steepest_side():
    line = np.array([[0.0, 1e-7, 4e-7, 3e-7]])
    assert height_map.steepest(line, STEPS) == pytest.approx(0.15) == height_map.steepest(line.T, STEPS[::-1])


def test_a_grid_sees_nothing_of_a_map_within_one_cell():
    """Before and behind it the surface is smooth; along the other axis it may be long."""
    bump = np.outer(np.hanning(9), np.hanning(200))
    assert height_map.error_on_grid(bump, 10, 8.5) == pytest.approx(1.0) == height_map.error_on_grid(bump.T, 8.5, 10)
    assert height_map.error_on_grid(bump, 10, 1) < 0.02 and height_map.error_on_grid(bump[4:5], 10, 10) < 0.02
    _, small = passing(0.3e-6 * np.outer(np.hanning(4), np.hanning(6)), taper=0.0)
    assert any("the map is off by 100% of its rms" in one for one in doubtful_features(small))


@pytest.mark.parametrize("axes", MIRRORED)
@pytest.mark.parametrize("seed", [5, 11])
def test_spikes_are_found_in_the_mirror_image(seed, axes):
    """Of more points than those that give the usual deviation."""
    heights, rng = rough((333, 401), seed), np.random.default_rng(seed)
    for j, i in zip(rng.integers(0, 332, 200), rng.integers(0, 400, 200)):
        heights[j:j + 2, i:i + 2] += rng.uniform(1e-6, 4e-6)
    found, mirrored = (outliers.spikes(values, (2e-6, 2e-6)) for values in (heights, heights[MIRRORED[axes]]))
    assert found.sum() > 100 and np.array_equal(found[MIRRORED[axes]], mirrored)


def test_marks_at_even_distances_are_no_spikes_wherever_they_begin():
    """Narrow valleys in every eighth column: the usual deviation is that of all columns."""
    rows, columns = 400, 400
    marks = rough((rows, columns), 7, 0.02e-6)
    marks[:, ::8] -= 0.5e-6
    deviations = [outliers._usual_deviation(np.pad(np.roll(marks, by, axis=1), 3, constant_values=np.nan), marks.shape, (3, 3))
                  for by in range(0, 8, 3)]
    assert deviations == pytest.approx([deviations[0]] * 3, rel=0.1)
