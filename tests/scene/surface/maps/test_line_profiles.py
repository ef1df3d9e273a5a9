"""Line profiles: files of styli, their direction in the contact, what they share with maps."""

import dataclasses
import pickle
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from commands import here as tehl
from map_feature import feature

from tehl_taichi.errors import SceneError
from tehl_taichi.report import surface_plots
from tehl_taichi.scene import scan_scene, scene, scene_file
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.surface.maps import height_map, line_profiles
from tehl_taichi.view.figures import height_profile

X = 2.0 * np.arange(150)  # um
HEIGHTS = np.round(0.2 * np.sin(2 * np.pi * X / 60) + 0.1 * np.cos(2 * np.pi * X / 44), 5)
COLUMN = [f"{z:.5f}" for z in HEIGHTS]
PAIRS = [f"{x / 1e3:.4f}\t{z}" for x, z in zip(X, COLUMN)]
MAHR = ["[PROFILE_HEADER]", "Operator=a", "[PROFILE_VALUES]", "// index = x z",
        *(f"{n}={x / 1e3:.6f} {z}" for n, (x, z) in enumerate(zip(X, COLUMN), 1)), "[END]", "1 2"]
FILES = {"column": COLUMN, "decimal commas": [one.replace(".", ",") for one in COLUMN], "two columns": PAIRS,
         "blanks and decimal commas": [pair.replace("\t", "  ").replace(".", ",") for pair in PAIRS],
         "numbered": [f"{n}, {x:.1f}, {z}" for n, (x, z) in enumerate(zip(X, COLUMN))],
         "header": ["Profile of a flank", "x [mm];z [um]", *(pair.replace("\t", ";") for pair in PAIRS)],
         "one row": [" ".join(COLUMN)], "two rows": [",".join(f"{x:g}" for x in X), ",".join(COLUMN)], "section": MAHR}


def profile(file, **changes):
    return feature(file, **{"shape": "profile", "pixel": 2e-6, "level": "none", **changes})


@pytest.fixture
def column(tmp_path):
    (tmp_path / "a.txt").write_text("\n".join(COLUMN))
    return tmp_path / "a.txt"


@pytest.mark.parametrize("name", FILES)
def test_files_of_line_profiles(tmp_path, name):
    (tmp_path / "a.txt").write_text("\n".join(FILES[name]))
    table = height_map.table_of(tmp_path / "a.txt")
    np.testing.assert_array_equal(table.values, HEIGHTS[None])
    placed = name not in ("column", "decimal commas", "one row")
    assert (table.spacing[0] is not None) == placed == ("coordinates (0 to " in table.skipped)
    assert profile(tmp_path / "a.txt").points == (150, 1)
    if placed:
        with pytest.raises(SceneError, match="feature.pixel = 3e-06 m (does not match|contradicts)"):
            profile(tmp_path / "a.txt", pixel=3e-6)


@pytest.mark.parametrize("shape", [(150,), (1, 150), (150, 1)])
def test_arrays(tmp_path, shape):
    np.save(tmp_path / "a.npy", HEIGHTS.reshape(shape))
    np.testing.assert_array_equal(profile(tmp_path / "a.npy").heights, HEIGHTS[None])
    f = Feature.from_heights(HEIGHTS.reshape(shape), pixel=2e-6, unit="um", level="none")
    assert f == profile(tmp_path / "a.npy", taper=0.0) and f.shape == "profile" and pickle.loads(pickle.dumps(f)) == f


def test_places_with_few_digits_are_even(tmp_path):
    """Heights are not moved to where their rounded places lie."""
    np.savetxt(tmp_path / "a.txt", np.column_stack([X * 0.8e-3, HEIGHTS]), fmt=["%.3f", "%.5f"])
    table = height_map.table_of(tmp_path / "a.txt")
    np.testing.assert_array_equal(table.values, HEIGHTS[None])
    assert "interpolated" not in table.skipped and table.spacing[0] == pytest.approx(1.6e-3, rel=0.003)


def test_uneven_places_are_made_even(tmp_path):
    x = np.linspace(0, 100, 101)
    x[1:-1] += 0.3 * np.sin(x[1:-1])
    np.savetxt(tmp_path / "a.txt", np.column_stack([x, 0.01 * x]), fmt="%.6f")  # a straight line stays one
    table = height_map.table_of(tmp_path / "a.txt")
    np.testing.assert_allclose(table.values[0], np.linspace(0, 1, 101), atol=1e-6)
    assert "interpolated at even ones" in table.skipped and table.spacing == (1.0, None)
    x[50:] = x[50:][::-1]
    np.savetxt(tmp_path / "b.txt", np.column_stack([x, 0.01 * x]), fmt="%.6f")  # a stylus does not go back
    with pytest.raises(SceneError, match="at least 4 x 4 heights"):
        height_map.table_of(tmp_path / "b.txt")


@pytest.mark.parametrize("off, kept", [(0.04, True), (0.08, False)])
def test_places_that_are_off_by_little_keep_their_heights(off, kept):
    x, z = np.arange(60.0), np.random.default_rng(2).random(60)
    x[1:-1:2] += off
    heights, _, found = line_profiles.heights_of(np.column_stack([x, z]))
    assert np.array_equal(heights[0], z) == kept and (line_profiles.UNEVEN not in found) == kept


@pytest.mark.parametrize("changes", [{}, {"level": "plane"}, {"level": "form"}, {"cutoff": 40e-6}, {"scale": -2.0},
                                     {"extent_x": 120e-6, "taper": 20e-6}, {"mirror_x": True}])
def test_a_transverse_profile_is_the_map_whose_rows_are_all_alike(tmp_path, column, changes):
    np.save(tmp_path / "rows.npy", np.tile(HEIGHTS, (61, 1)))
    line, rows = profile(column, **changes), profile(tmp_path / "rows.npy", shape="map", **changes)
    x = np.linspace(-160e-6, 160e-6, 333)
    np.testing.assert_allclose(line.height_at(x, 0.7e-3), rows.height_at(x, 0.0), atol=1e-15)
    for name in ("rms", "range", "slope"):
        assert getattr(line.unfaded, name) == pytest.approx(getattr(rows.unfaded, name), rel=1e-9)
    assert line.transverse and line.symmetric and not rows.transverse and line.reach == rows.reach
    assert line.position_in_file(31e-6, 1.0) == ("point 60" if "mirror_x" in changes else "point 91")


def test_marks_along_x_are_heights_over_y(column):
    line, across = profile(column), profile(column, lay="longitudinal", mirror_y=True)
    at = np.linspace(-140e-6, 140e-6, 77)
    np.testing.assert_allclose(across.height_at(0.0 * at, -at), line.height_at(at, 0 * at), atol=1e-18)
    assert not across.transverse and not across.symmetric and across.points == (1, 150)
    assert across.patch == pytest.approx((298e-6, 298e-6)) and across.reach_y == pytest.approx(149e-6)
    assert profile(column, lay="longitudinal", extent_x=1e-3).reach == 0.5e-3
    narrow = profile(column, extent_y=100e-6)
    assert not narrow.transverse and narrow.symmetric and narrow.height_at(10e-6, 60e-6) == 0 != narrow.height_at(10e-6, 30e-6)


def gear_with(f):
    return dataclasses.replace(scene("gear"), features=(f,)).replace(**{"grid.nx": 512})


def test_a_line_contact_stays_a_line(column):
    line, across = (gear_with(profile(column, taper=30e-6, lay=lay)) for lay in ("transverse", "longitudinal"))
    assert line.one_dimensional and not across.one_dimensional
    assert height_profile.heights(line).line and height_profile.heights(across).values.shape == (399, 399)
    first, second = line.features[0].kind.preview(line.features[0], line)
    assert "150 points 2 um apart, 298 um of them used" in first and "transverse (heights over x" in first
    assert second.endswith("a cell of the grid has 1.41 points")
    told = dict(surface_plots.map_facts(line.features[0], line))
    assert told["points"] == "150" and told["patch used"].startswith("298 µm, fading") and "lay" in told
    assert any("points 2 um apart" in one for one in line.warnings()) is False
    steep = gear_with(profile(column, scale=20.0, taper=30e-6))
    assert any("feature.cutoff = " in one and "slopes up to" in one for one in steep.warnings())


@pytest.mark.parametrize("lay, axis", [("transverse", "x"), ("longitudinal", "y")])
def test_the_preview_names_offsets_and_distances_along_its_own_axis(column, lay, axis):
    keys = {"taper": 20e-6, "lay": lay, "extent_x": 1.2e-4, "extent_y": 1.2e-4, "pixel_y": 5e-6 if axis == "x" else 0.0}
    f = profile(column, offset_x=4e-5, offset_y=4e-5, **keys)
    first, _ = f.kind.preview(f, gear_with(f))
    assert "150 points 2 um apart" in first and f"used around {axis} = 40 um, fading" in first


@pytest.mark.parametrize("keys, stepped", [({}, False), ({"extent_y": 1e-4}, True), ({"lay": "longitudinal"}, True),
                                           ({"extent_x": 2e-4}, True)])
def test_an_endless_profile_has_a_rim_at_its_ends_alone(keys, stepped):
    """Two hills between zeros; where they are cut, along x or y, there is a step."""
    hills = Feature.from_heights(3e-7 * np.sin(np.linspace(0, 2 * np.pi, 120)) ** 2, 3e-6, level="none", **keys)
    assert any("ends in a step" in said for said in gear_with(hills).warnings()) == stepped


@pytest.mark.parametrize("lay", ["transverse", "longitudinal"])
def test_a_profile_across_the_curvature_is_asked_about_its_lay(lay):
    x = 3e-6 * (np.arange(120) - 59.5)
    f = Feature.from_heights(-x * x / 2 / 0.02, 3e-6, level="form", lay=lay, taper=3e-5)
    found = [said for said in gear_with(f).warnings() if "across the rolling direction" in said]
    assert len(found) == (lay == "longitudinal") and all(said.endswith("feature.lay = 'transverse'") for said in found)
    dataclasses.replace(f, lay="transverse")  # is taken


@pytest.mark.parametrize("changes, words", [
    ({"shape": "map"}, "is a line profile of 150 heights; set feature.shape = 'profile'"),
    ({"transpose": True}, "needs shape = 'map'"), ({"lay": "across"}, "transverse, longitudinal"),
    ({"extent_x": 1e-3}, "at most 0.000298 m"), ({"cutoff": 1e-3}, "at most 0.000298 m"), ({"pixel": 0.0}, "pixel is missing")])
def test_what_cannot_be_meant_is_refused(column, changes, words):
    with pytest.raises(SceneError, match=words):
        profile(column, **changes)


@pytest.mark.parametrize("dim", [1, 2])
def test_what_the_reader_of_instruments_gives(tmp_path, monkeypatch, dim):
    """A line as places and heights, a grid with x first."""
    grid = np.outer(HEIGHTS[:30], np.cos(np.arange(9.0) ** 2))
    grid = np.ma.masked_equal(grid, grid.max())
    read = SimpleNamespace(dim=dim, unit=None, heights=lambda: HEIGHTS if dim == 1 else grid, positions=lambda: X,
                           physical_sizes=None, nb_grid_pts=grid.shape)
    monkeypatch.setitem(sys.modules, "SurfaceTopography", SimpleNamespace(read_topography=lambda name: read))
    (tmp_path / "a.sur").write_bytes(b"x")
    table = height_map.table_of(tmp_path / "a.sur")
    np.testing.assert_array_equal(table.values, HEIGHTS[None] if dim == 1 else grid.filled(np.nan).T)
    assert table.spacing == ((2.0, None) if dim == 1 else (None, None)) and table.stated.unit == ""


def test_a_map_is_no_profile(tmp_path):
    np.save(tmp_path / "a.npy", np.ones((20, 30)))
    with pytest.raises(SceneError, match="20 x 30 heights, no line profile; set feature.shape = 'map'"):
        profile(tmp_path / "a.npy")


def test_a_scene_for_a_profile(column, tmp_path):
    read, missing, _ = scan_scene.new(tmp_path / "mine.toml", "gear", column, "um", 2e-6, lay="longitudinal")
    assert read == "a line profile of 150 points" and missing == []
    f, = scene_file.load(tmp_path / "mine.toml").features
    assert (f.shape, f.lay, f.pixel, f.taper) == ("profile", "longitudinal", 2e-6, pytest.approx(37e-6))
    with pytest.raises(SceneError, match="pixel_y 1e-06 has no effect: .* is a line profile"):
        scan_scene.new(tmp_path / "b.toml", "gear", column, "um", 2e-6, 1e-6)
    np.save(tmp_path / "map.npy", np.ones((20, 30)))
    done = tehl("new", "c.toml", "--scan", "map.npy", "--lay", "transverse", cwd=tmp_path)
    assert done.returncode == 2 and "--lay transverse has no effect" in done.stderr


@pytest.mark.parametrize("falls", [False, True])
def test_uneven_places_keep_their_heights_in_either_direction(falls):
    x = np.cumsum(np.random.default_rng(8).uniform(0.5, 1.5, 40))
    x = x[::-1] if falls else x
    heights, step, found = line_profiles.heights_of(np.column_stack([x, 0.3 * x + 1]))
    np.testing.assert_allclose(heights[0], 0.3 * np.linspace(x[0], x[-1], 40) + 1, rtol=1e-12)
    assert found[-1] == line_profiles.UNEVEN and step == pytest.approx((x[-1] - x[0]) / 39)
