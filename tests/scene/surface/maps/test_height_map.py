"""Measured height maps: their keys, what is refused and doubted, and their place in a store."""

import dataclasses
import gc
import pickle
import shutil
import weakref

import numpy as np
import pytest
from map_feature import feature

import tehl_taichi as tehl
from tehl_taichi.march import passage
from tehl_taichi.scene import SceneError, scene, scene_file
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.scene_warnings import doubtful_features as doubts
from tehl_taichi.scene.scene_warnings import preview
from tehl_taichi.scene.surface.maps import height_map, instrument_files

TOML = 'base = "gear"\n[[feature]]\nshape = "map"\nfile = "scan.npy"\nunit = "um"\npixel = 1e-6\n'
SMALL = {"grid.nx": 64, "grid.ny": 16, "thermal.on": False}


def wave(tmp_path, height=0.2, length=100.0, name="scan.npy", points=(61, 121)):
    """A wave of `length` points along x (and twice that along y), tilted and lifted; heights in the unit of the caller."""
    y, x = np.mgrid[: points[0], : points[1]].astype(float)
    values = height * np.cos(2 * np.pi * x / length) * np.cos(np.pi * y / length) + 0.003 * x - 0.001 * y + 5
    np.save(tmp_path / name, values)
    return tmp_path / name


def with_map(file, **changes):
    """The gear contact, coarse and isothermal, with the map in place of its asperity."""
    return dataclasses.replace(scene("gear"), features=(feature(file),)).replace(**{**SMALL, **changes})


def test_the_same_surface_in_another_unit_is_the_same_surface(tmp_path):
    um, nm = wave(tmp_path), wave(tmp_path, name="nm.npy")
    np.save(nm, np.load(um) * 1e3)
    one, other = feature(um), feature(nm, unit="nm")
    np.testing.assert_allclose(one.whole_heights, other.whole_heights, atol=1e-18)
    assert one.unfaded.rms == pytest.approx(np.std(one.whole_heights)) and 0.05e-6 < one.measures.rms < 0.2e-6
    assert feature(um, unit="\u00b5m").unit == "um"
    np.testing.assert_allclose(feature(um, scale=-2.0).whole_heights, -2 * one.whole_heights)


def test_a_map_gives_the_feature_it_was_sampled_from(tmp_path):
    bump = Feature(height=2e-6, width=100e-6)
    x = np.arange(-60, 61) * 1e-6
    np.save(tmp_path / "bump.npy", bump.height_at(x[None, :], x[:, None]) * 1e6)
    map_ = feature(tmp_path / "bump.npy", level="none", taper=2e-6)
    X, Y = np.meshgrid(np.linspace(-80e-6, 80e-6, 77), np.linspace(-80e-6, 80e-6, 53))
    np.testing.assert_allclose(map_.height_at(X, Y), bump.height_at(X, Y), atol=2e-9)
    assert map_.reach == pytest.approx(60e-6) and map_.top == pytest.approx(2e-6) and not map_.symmetric


def test_a_tilted_map_is_levelled_and_a_broken_one_refused(tmp_path, monkeypatch):
    y, x = np.mgrid[:20, :30]
    np.savetxt(tmp_path / "tilt.csv", 3.0 + 0.2 * x - 0.1 * y, delimiter=",")
    assert np.abs(feature(tmp_path / "tilt.csv", taper=5e-6).whole_heights).max() < 1e-18
    mean = feature(tmp_path / "tilt.csv", level="mean", taper=5e-6)
    assert mean.unfaded.low == pytest.approx(-(0.2 * 14.5 + 0.1 * 9.5) * 1e-6)
    (tmp_path / "broken.csv").write_text("1,2\n3,4\n")
    with pytest.raises(SceneError, match=r"4 x 4 heights, or a line profile of 8, not numbers of shape \(2, 2\)"):
        feature(tmp_path / "broken.csv")
    (tmp_path / "scan.sur").write_text("x")
    monkeypatch.setattr(instrument_files, "_installed", lambda name: False)  # as without the extra
    with pytest.raises(SceneError, match="topography"):
        feature(tmp_path / "scan.sur")


@pytest.mark.parametrize("name, row", [("a.csv", "1.5, 2,3, 4e1"), ("b.csv", "1,5;2;3;4e1;"), ("c.csv", "1,5\t2\t3\t4e1\t"),
                                       ("d.txt", "# x; y, nm\n1.5 2   3 4e1 "), ("e.asc", "\ufeff1.5,2,3,4e1\r")])
def test_tables_are_read_as_instruments_write_them(tmp_path, name, row):
    (tmp_path / name).write_text("\n".join([row, *[row.lstrip("\ufeff")] * 3]), encoding="utf-8")
    assert height_map.table_of(tmp_path / name).values.tolist() == [[1.5, 2.0, 3.0, 40.0]] * 4


@pytest.mark.parametrize("mark, end", [(",", ""), (";", ";"), ("\t", "")])
def test_nothing_between_two_marks_was_not_measured(tmp_path, mark, end):
    rows = [["1", "2", "3", "4"]] * 30 + [["", "2", " ", "nan"]]
    (tmp_path / "scan.csv").write_text("".join(mark.join(row) + end + "\n" for row in rows))
    values = height_map.table_of(tmp_path / "scan.csv").values
    assert values.shape == (31, 4) and np.isnan(values[30]).tolist() == [True, False, True, True]
    np.testing.assert_array_equal(values[:30], [[1, 2, 3, 4]] * 30)


def test_small_holes_are_filled_from_their_neighbours_and_told_of(tmp_path):
    y, x = np.mgrid[:40, :50]
    heights = 0.3 * x - 0.1 * y
    np.save(tmp_path / "whole.npy", heights)
    heights[3:10, 20:27] = heights[30, 5:9] = np.nan
    np.save(tmp_path / "holes.npy", heights)
    whole, holed = (feature(tmp_path / f"{name}.npy", unit="nm", level="none", taper=5e-6) for name in ("whole", "holes"))
    np.testing.assert_allclose(holed.whole_heights, whole.whole_heights, atol=1e-6 * 20e-9)  # a plane solves Laplace's equation
    said = [one for one in with_map(tmp_path / "holes.npy").warnings() if "not measured" in one]
    assert len(said) == 1 and "53 of its 2000 points" in said[0]
    assert height_map.fetch("", holed.sha256)[0] == holed.sha256 != whole.sha256


@pytest.mark.parametrize("hole, words", [
    (np.s_[:, :4], r"lacks 160 of its 2000 heights \(8 %\)"), (np.s_[:9, :9], "holes of up to 18 points"),
    (np.s_[:], r"lacks 2000 of its 2000 heights \(100 %\), in holes of up to 50 p")])
def test_heights_are_not_invented(tmp_path, hole, words):
    heights = np.ones((40, 50))
    heights[hole] = np.nan
    np.save(tmp_path / "scan.npy", heights)
    with pytest.raises(SceneError, match=f"{words}.*allowed: 5 %, holes of 16.*filled from their neighbours"):
        feature(tmp_path / "scan.npy")


@pytest.mark.filterwarnings("error")  # the sentence says it all
@pytest.mark.parametrize("told", ["1,2,3,4\nheight in nm\n" + 4 * "1,2,3,4\n", "1;2;3;4\n1;2;3\n" * 4, "", "1,2,3\n4,five,6\n"])
def test_tables_with_something_else_in_them_are_refused(tmp_path, told):
    (tmp_path / "scan.csv").write_text(told, encoding="utf-8")
    with pytest.raises(SceneError, match="cannot read heights from .*scan.csv|at least 4 x 4 heights"):
        feature(tmp_path / "scan.csv")


def test_the_largest_slope_is_that_of_the_ramp(tmp_path):
    y, x = np.mgrid[:40, :50] * 2e-6
    np.save(tmp_path / "ramp.npy", 0.03 * x + 0.04 * y)
    found = feature(tmp_path / "ramp.npy", unit="m", pixel=2e-6, level="none", taper=0.0).measures
    assert found.slope == pytest.approx(np.degrees(np.arctan(0.05))) and found.low == 0
    assert found.range == pytest.approx(0.03 * 98e-6 + 0.04 * 78e-6)
    part = feature(tmp_path / "ramp.npy", unit="m", pixel=2e-6, level="none", extent_x=48e-6, extent_y=38e-6, taper=0.0).unfaded
    assert part.range == pytest.approx(0.03 * 48e-6 + 0.04 * 38e-6, rel=0.06)  # whole points: one more at most


@pytest.mark.parametrize("changes, words", [
    ({"unit": ""}, "feature.unit is missing.*nm, um, mm, m"), ({"pixel": 0.0}, "feature.pixel is missing"),
    ({"file": ""}, ".csv, .txt, .asc, .npy"), ({"file": "none.npy"}, "does not exist"),
    ({"unit": "inch"}, "allowed: nm, um, mm, m"),
    ({"unit": "mm"}, r"ranges over 0.0004\d+ m; allowed: at most 0.0001 m. Is feature.unit = 'mm' right"),
    ({"pixel": 1e-9}, r"slopes of 8\d.\d deg; allowed: at most 45 deg.*feature.pixel = 1e-09 m"),
    ({"height": 1e-6}, "feature.scale"), ({"extent_x": 1e-3}, "at most 0.00012 m"), ({"extent_y": 1e-6}, "at least 3e-06 m"),
    ({"sha256": "ab" * 32}, "has changed"), ({"shape": "cosine"}, "needs shape = 'map'"),
])
def test_a_map_that_cannot_be_meant_is_refused_with_value_and_range(tmp_path, changes, words):
    with pytest.raises(SceneError, match=words):
        feature(**{"file": wave(tmp_path), **changes})


@pytest.mark.parametrize("values", [np.float64(3.0), np.ones(5), np.zeros(0), np.zeros((0, 5)), np.ones((9, 9, 9)),
                                    np.ones((2, 2))])
def test_arrays_of_another_shape_are_refused_in_a_sentence(tmp_path, values):
    np.save(tmp_path / "scan.npy", values)
    with pytest.raises(SceneError, match="must hold a grid of at least 4 x 4 heights|an array of . dimensions; allowed: 2 "):
        feature(tmp_path / "scan.npy")
    with pytest.raises(SceneError, match="heights have the shape"):
        Feature.from_heights(values, 1e-6)


def test_a_mask_is_a_hole(tmp_path):
    """As nan, in an array and in a list of rows; without masked heights it changes nothing."""
    z, mask = 1e-6 * np.random.default_rng(3).random((30, 40)), np.zeros((30, 40), bool)
    mask[4:6, 7:9] = True
    bare = Feature.from_heights(np.where(mask, np.nan, z), 2e-6)
    for given in (np.ma.array(z, mask=mask), [*np.ma.array(z, mask=mask)]):
        assert Feature.from_heights(given, 2e-6) == bare and bare.holes.sum() == 4
    assert Feature.from_heights(np.ma.array(z), 2e-6) == Feature.from_heights(z, 2e-6)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("least", [np.inf, -np.inf])
def test_infinite_heights_are_holes(least):
    z = 1e-6 * np.random.default_rng(3).random((30, 40))
    holed, infinite = z.copy(), z.copy()
    holed[4:6, 7:9], infinite[4:6, 7:8], infinite[4:6, 8:9] = np.nan, np.inf, least
    one, other = (Feature.from_heights(values, 2e-6, taper=1e-5) for values in (holed, infinite))
    np.testing.assert_array_equal(one.whole_heights, other.whole_heights)
    said = [doubts(dataclasses.replace(scene("gear"), features=(f,))) for f in (one, other)]
    assert said[0] == said[1] and any("not measured" in one for one in said[0]) and other.holes.sum() == 4


@pytest.mark.parametrize("changes, words", [
    ({"shape": "map"}, "from_heights: shape = 'map' has no effect"),
    ({"sha256": "ab"}, "from_heights: sha256 = 'ab' has no effect"),
    ({"file": "scan.npy"}, "from_heights: file = 'scan.npy' has no effect"),
    ({"scale": 500.0}, "^the array of heights, in m with level = 'plane', ranges over"),
    ({"pixel": 1e-9}, "^the array of heights, in m with level = 'plane', has slopes of")])
def test_refusals_of_an_array_speak_of_it(changes, words):
    with pytest.raises(SceneError, match=words):
        Feature.from_heights(1e-6 * np.random.default_rng(3).random((30, 40)), **{"pixel": 2e-6, **changes})


def test_what_is_no_grid_of_numbers_is_refused(tmp_path):
    np.save(tmp_path / "words.npy", np.full((5, 5), "a"))
    np.save(tmp_path / "complex.npy", np.ones((5, 5)) * 1j)
    (tmp_path / "empty.npy").write_bytes(b"")
    for name in ("words", "complex", "empty"):
        with pytest.raises(SceneError, match="cannot read heights"):
            feature(tmp_path / f"{name}.npy")


def test_the_preview_tells_points_range_rms_slope_and_points_per_cell(tmp_path):
    first, second, *_ = preview(with_map(wave(tmp_path)))
    assert "121 x 61 points 1 um apart, 120 x 60 um" in first and "heights in um, plane removed" in first
    f = with_map(wave(tmp_path)).features[0]
    assert f"range {f.measures.range * 1e6:.4g} um" in second and f"rms {f.measures.rms * 1e6:.4g} um" in second
    assert f"slope {f.measures.slope:.2g} deg" in second and "a cell of the grid has 22.6 x 22.6 points" in second


def test_tehl_run_shows_the_map_before_it_computes_anything(taichi_cpu, tmp_path, monkeypatch):
    from tehl_cli.main import app
    from typer.testing import CliRunner

    from tehl_taichi.errors import NotConverged

    def stop(scene):
        raise NotConverged("far enough")

    wave(tmp_path)
    (tmp_path / "my.toml").write_text(TOML)
    monkeypatch.setattr(passage, "march", stop)
    monkeypatch.chdir("/")
    words = ["run", str(tmp_path / "my.toml"), "--threads", "2", "--precision", "f64", "--out", str(tmp_path / "o.zarr")]
    done = CliRunner().invoke(app, words)
    assert isinstance(done.exception, NotConverged)
    at = [done.output.find(words) for words in ("map scan.npy: 121 x 61 points", "map scan.npy: -0.", "warning: feature.file")]
    assert -1 < at[0] < at[1] < at[2], done.output
    quiet = CliRunner().invoke(app, [*words, "--quiet"])
    assert "points" not in quiet.output and "warning: feature.file" in quiet.output


def test_a_map_finer_than_the_grid_is_doubted_and_the_grid_named_is_fine(tmp_path):
    rough = with_map(wave(tmp_path, length=60.0))
    (sentence,) = doubts(rough)
    assert "on this grid the" in sentence and sentence in rough.typed_warnings
    nx, ny = sentence.split("--grid ")[1].split()[0].split("x")
    assert doubts(rough.replace(**{"grid.nx": int(nx), "grid.ny": int(ny)})) == []
    assert doubts(rough.replace(**{"grid.nx": int(nx) // 2, "grid.ny": int(ny) // 2})) != []


def test_waves_that_a_grid_turns_into_others_are_more_than_the_map(tmp_path):
    found = doubts(with_map(wave(tmp_path, length=17.0), **{"grid.nx": 64, "grid.ny": 16}))
    (sentence,) = (said for said in found if "on this grid the" in said)
    off = int(sentence.split("is off by ")[1].split("%")[0])
    assert off > 100 and "loses" not in sentence


def test_points_too_few_for_their_own_roughness_are_doubted(tmp_path):
    sparse = {"feature.pixel": 15e-6, "feature.taper": 1e-4, "grid.nx": 512, "grid.ny": 128}
    assert any("do not resolve" in sentence for sentence in doubts(with_map(wave(tmp_path, length=4.0), **sparse)))
    assert doubts(with_map(wave(tmp_path, length=60.0), **sparse)) == []


@pytest.mark.parametrize("turned, steps, doubted", [(False, (1e-6, 20e-6), False), (True, (20e-6, 1e-6), False),
                                                    (False, (20e-6, 1e-6), True), (True, (1e-6, 20e-6), True)])
def test_only_points_farther_apart_than_cells_are_doubted(turned, steps, doubted):
    """Rows that hardly differ, of rough rows; cells are 11 um."""
    heights = 1e-8 * np.random.default_rng(2).normal(size=240) * np.linspace(0.8, 1.2, 30)[:, None]
    f = Feature.from_heights(heights.T if turned else heights, *steps, taper=5e-6)
    said = doubts(dataclasses.replace(scene("gear"), features=(f,)).replace(**{"grid.nx": 128, "grid.ny": 32}))
    assert any("do not resolve" in one for one in said) == doubted


def test_flat_steep_and_cut_off_maps_are_doubted(tmp_path):
    smooth = {"grid.nx": 256, "grid.ny": 64}
    rms = feature(wave(tmp_path)).measures.rms * 1e6
    assert any(f"rms of {rms:.2g} nm" in s and "check feature.unit = 'nm'" in s
               for s in doubts(with_map(wave(tmp_path), **smooth, **{"feature.unit": "nm"})))
    assert any("slopes up to" in s for s in doubts(with_map(wave(tmp_path, height=4.0, length=60.0), **smooth)))
    assert doubts(with_map(wave(tmp_path), **smooth)) == []
    assert any("step of up to 0.2" in s for s in doubts(with_map(wave(tmp_path), **smooth, **{"feature.taper": 0.0})))


def test_what_a_grid_misses_is_what_linear_cells_miss():
    from tehl_taichi.scene.surface.maps.height_map import error_on_grid

    x = np.arange(2001.0)
    for cells in (4.5, 8.0, 20.0):  # of linear interpolation of a wave of that many cells: (2 pi/cells)^2 sqrt(1/120 + ...)
        heights = np.tile(np.cos(2 * np.pi * x / (cells * 25)), (9, 1))
        assert error_on_grid(heights, 25, 1) == pytest.approx((2 * np.pi / cells) ** 2 * np.sqrt(1 / 120), rel=0.12)
    assert error_on_grid(heights, 0.5, 1) == 0 == error_on_grid(0 * heights, 25, 3)


def test_paths_start_at_the_scene_file_and_a_changed_file_is_another_scene(tmp_path, monkeypatch):
    (tmp_path / "maps").mkdir()
    wave(tmp_path / "maps")
    toml = tmp_path / "maps" / "my.toml"
    toml.write_text(TOML)
    monkeypatch.chdir("/")
    first = scene_file.load(toml)
    assert first.features[0].file == str(tmp_path / "maps" / "scan.npy")
    wave(tmp_path / "maps", height=0.1)
    changed = scene_file.load(toml)
    assert changed != first and changed.features[0].measures.rms < 0.6 * first.features[0].measures.rms
    again = first.replace(**{"time.steps": 3}).replace(**{"time.steps": -1})
    assert again == first and again.features[0].measures == first.features[0].measures  # as it was made, not as the file is now
    other = first.replace(**{"feature.file": str(wave(tmp_path, height=0.3))})
    assert other.features[0].sha256 not in (first.features[0].sha256, changed.features[0].sha256)


def test_a_written_scene_refuses_a_changed_file(tmp_path):
    description = with_map(wave(tmp_path, height=0.17))  # heights that no other test holds: they are gone with the scene
    (tmp_path / "s.toml").write_text(scene_file.dumps(description))
    assert scene_file.load(tmp_path / "s.toml") == description
    del description
    gc.collect()
    wave(tmp_path, height=0.1)
    with pytest.raises(SceneError, match="remove feature.sha256"):
        scene_file.load(tmp_path / "s.toml")


def test_a_scene_carries_its_heights_to_another_process(tmp_path):
    description = with_map(wave(tmp_path, height=0.19))
    rms = description.features[0].measures.rms
    parcel = pickle.dumps(description)
    assert len(parcel) < 1.2 * description.features[0].heights.nbytes + 2e4  # nothing that follows from them
    del description
    (tmp_path / "scan.npy").unlink()
    arrived = pickle.loads(parcel)
    assert arrived.replace(srr=-0.2).features[0].measures.rms == rms


@pytest.fixture(scope="module")
def moved(taichi_cpu, tmp_path_factory):
    """(scene, store of its first three steps, store of all four): one broken off, then moved and its map file removed."""
    from tehl_taichi.march.passage import march
    from tehl_taichi.runs.single_run import run_or_resume
    from tehl_taichi.store.store import Store

    home = tmp_path_factory.mktemp("home")
    turned = {"feature.transpose": True, "feature.mirror_x": True}
    description = with_map(wave(home, length=60.0), **{"time.steps": 4, "fatigue.depths": ()}, **turned)
    whole = run_or_resume(description, home / "whole.zarr")
    run = march(description)
    broken = Store.create(home / "broken.zarr", description, next(run), 5, {"steady_error": "{}", "steady_unknown": "{}"})
    for _ in range(2):
        shot = next(run)
        broken.append(shot, shot.state)
    (home / "scan.npy").unlink()
    away = tmp_path_factory.mktemp("away")
    return description, *(shutil.move(home / store.path.name, away / store.path.name) for store in (broken, whole))


@pytest.fixture
def elsewhere(monkeypatch):
    """As in another process: no heights are known."""
    monkeypatch.setattr(height_map, "_known", weakref.WeakValueDictionary())


def test_a_moved_store_goes_on_without_the_map_file(moved, elsewhere):
    from tehl_taichi.runs.single_run import run_or_resume
    from tehl_taichi.store.store import Store

    description, broken, whole = moved
    assert Store.open(broken).scene == description
    again = Store.open(broken).scene.features[0].whole_heights
    np.testing.assert_array_equal(again, description.features[0].whole_heights)  # turned once
    a, b = run_or_resume(description, broken).store, Store.open(whole)  # resumes
    assert len(a) == len(b) == 5 and np.array_equal(a.fields(4)["film"], b.fields(4)["film"])


def test_a_moved_store_is_opened_by_xarray_plotted_and_run_again(moved, elsewhere, tmp_path):
    from tehl_taichi.store.store import Store
    from tehl_taichi.view.figures.figure_style import FigureStyle
    from tehl_taichi.view.figures.run_figures import write_all

    xarray = pytest.importorskip("xarray")
    description, _, whole = moved
    data = xarray.open_zarr(whole)
    (name,) = (name for name in data if name.startswith("map_"))
    assert data[name].attrs["units"] == "um" and data[name].attrs["sha256"] == description.features[0].sha256
    np.testing.assert_array_equal(data[name], description.features[0].heights)
    assert {path.name for path in write_all(Store.open(whole), tmp_path, FigureStyle(dpi=40))} >= {"maps.png", "centreline.png"}
    again = tehl.scene(str(whole))
    assert again == description and again.replace(**{"time.steps": 1}).features[0].measures == description.features[0].measures


def test_on_the_whole_domain_cells_are_still_those_of_the_scene(moved):
    from tehl_taichi.runs.summary.summary import grid_counts
    from tehl_taichi.store.store import Store

    found = grid_counts(Store.open(moved[2]))
    assert found == {"grid": {"nx": 65, "ny": 33, "nz": 1}, "cells": {"nx": 64, "ny": 16}}


def test_its_summary_has_the_roughness_that_passed_and_the_film_over_it(moved):
    from tehl_taichi.store.store import Store

    f, found = moved[0].features[0], Store.open(moved[2]).summary
    z = f.whole_heights - f.whole_heights.mean()
    numbers = found["roughness"]["a"]
    assert (numbers["Sa_m"], numbers["Sq_m"], numbers["Sz_m"]) == pytest.approx((np.abs(z).mean(), z.std(), np.ptp(z)))
    assert numbers.keys() >= {"skewness", "Rq_slope", "length_x_m", "length_y_m"} and "combined" not in found["roughness"]
    assert found["lambda"] == pytest.approx(found["steady"]["h_c_m"] / z.std()) and "lambda" in found["error"]


def test_another_file_of_the_same_name_does_not_change_a_store(moved, elsewhere):
    from pathlib import Path

    from tehl_taichi.store.store import Store

    description, _, whole = moved
    file = Path(description.features[0].file)
    wave(file.parent, height=0.05)
    assert Store.open(whole).scene == description
    file.unlink()


def test_damaged_heights_in_a_store_are_refused(moved, tmp_path):
    import zarr

    from tehl_taichi.errors import StoreError
    from tehl_taichi.store.store import Store

    copy = shutil.copytree(moved[2], tmp_path / "copy.zarr")
    (name,) = (path.name for path in copy.glob("map_*"))
    zarr.open_group(str(copy), mode="r+", use_consolidated=False)[name][3, 3] += 1e-9
    with pytest.raises(StoreError, match="damaged"):
        Store.open(copy)
    shutil.rmtree(copy / name)
    with pytest.raises(StoreError, match="cannot be read"):
        Store.open(copy)


def test_a_store_of_the_first_version_stays_readable(tmp_path):
    """There `height` was m per unit of the file, the heights were not kept and pixel was 1e-6 unless told."""
    from tehl_taichi.store.stored_maps import scene_of

    data = with_map(wave(tmp_path)).to_dict()
    old = {key: value for key, value in data["feature"][0].items() if key not in ("unit", "scale", "sha256")}
    found = scene_of(tmp_path, {**data, "feature": [{**old, "height": 1e-6}]}).features[0]
    np.testing.assert_allclose(found.whole_heights, feature(tmp_path / "scan.npy").whole_heights, rtol=1e-12)
    bump = {key: value for key, value in scene("gear").to_dict()["feature"][0].items() if key in old}
    assert scene_of(tmp_path, {**scene("gear").to_dict(), "feature": [{**bump, "pixel": 1e-6}]}) == scene("gear")
