"""Grids that are chosen for the features of bearings and cams, and what a user left open."""

import json

import pytest
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.runs.flank import outcomes
from tehl_taichi.scene import grid_for_features, resolution, scene
from tehl_taichi.scene.feature import Feature

DENT = Feature(shape="dent", height=-10e-6, width=0.3e-3, rim=1.2e-6)
SMALL = Feature(shape="dent", height=-5e-6, width=0.1e-3, rim=0.5e-6)


def raceway(tmp_path, feature=DENT, which="6206", **options):
    """(scene of the ring that carries the feature, words about its grid)."""
    options = {"load": 5000.0, "speed": 3000.0, "on": "inner", "feature": feature, **options}
    made = tehl.bearing(which, **options, run=False, folder=tmp_path / "b")
    ring = made.rings[options["on"]]
    return tehl.scene(ring["scene_file"]), ring["grid"]


def cells(found):
    """Fewest cells of a length of the features, in the window where the scene has one."""
    return min(sight.cells for sight in resolution.sights(found)) * max(found.zoom.factor, 1)


@pytest.mark.parametrize("which, load, on", [("6206", 5000.0, "inner"), ("6206", 5000.0, "outer"), ("6203", 1000.0, "inner"),
                                             ("218", 15000.0, "inner")])
@pytest.mark.parametrize("feature", [DENT, Feature(height=-10e-6, width=0.3e-3)])
def test_a_dent_has_sixteen_cells_along_and_across(tmp_path, which, load, on, feature):
    """On default grids a cell across is as wide as half of the rim, and the rim lies between two nodes."""
    found, words = raceway(tmp_path, feature, which, load=load, on=on)
    assert cells(found) >= resolution.ENOUGH and not resolution.warnings(found)
    assert f"grid {found.grid.nx}x{found.grid.ny}" in words and "times the work" in words


def test_the_rim_is_what_the_grid_has_to_see(tmp_path):
    """Its width counts, whether the user gave it or not."""
    own, _ = raceway(tmp_path)
    given, _ = raceway(tmp_path / "given", Feature(shape="dent", height=-10e-6, width=0.3e-3, rim=1.2e-6, rim_width=75e-6))
    assert {sight.key for sight in resolution.sights(own)} == {"feature.rim_width"}
    assert (own.grid.nx, own.grid.ny) == (given.grid.nx, given.grid.ny)


def test_a_small_dent_has_a_window_where_a_grid_takes_too_long(tmp_path):
    found, words = raceway(tmp_path, SMALL)
    assert found.zoom.factor in (4, 8) and cells(found) >= resolution.ENOUGH and "times as fine" in words
    assert found.grid.ny * found.zoom.factor > 1500


@pytest.mark.parametrize("changes", [{"grid.nx": 256, "grid.ny": 320}, {"zoom.factor": 8, "grid.ny": 128}])
def test_the_grid_of_the_user_stays(tmp_path, changes):
    found, words = raceway(tmp_path, SMALL if "zoom.factor" in changes else DENT, changes=changes)
    assert found.grid.ny == changes["grid.ny"] and not words


def test_the_grid_of_a_scene_file_stays(tmp_path):
    (tmp_path / "mine.toml").write_text('base = "gear"\n[grid]\nnx = 256\nny = 320\n')
    found, words = raceway(tmp_path, scene=tehl.scene(tmp_path / "mine.toml"))
    assert (found.grid.nx, found.grid.ny) == (256, 320) and not words


def test_what_the_grid_resolves_keeps_it():
    assert grid_for_features.choose_grid(scene("gear")) == ({}, "")


def test_a_rough_window_beats_none_for_the_smallest_dents(tmp_path):
    """Eight cells, and the warning that says so; where no grid is left the refusal names a window."""
    found, words = raceway(tmp_path, Feature(shape="dent", height=-2e-6, width=30e-6, rim=0.2e-6))
    (warning,) = resolution.warnings(found)
    assert 8 <= cells(found) < resolution.ENOUGH and "of the window" in warning and words
    with pytest.raises(tehl.SceneError, match="zoom.factor=8 with grid.nx="):
        raceway(tmp_path / "tiny", Feature(shape="dent", height=-1e-6, width=10e-6, rim=0.1e-6))


def test_the_command_says_what_the_grid_costs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    typed = "bearing 6206 --load 5kN --speed 3000 --dent 10um,0.3mm,rim=1.2um --no-run --no-figure --json --out b".split()
    done = CliRunner().invoke(app, typed, prog_name="tehl")
    ring = json.loads(done.stdout)["inner"]
    assert "times the work" in done.stderr and ring["grid"] in done.stderr
    plain = CliRunner().invoke(app, [*typed[:-1], "c", "--grid", "256x320"], prog_name="tehl")
    assert "times the work" not in plain.stderr and json.loads(plain.stdout)["inner"]["grid"] == ""


def test_a_cam_has_a_grid_for_its_dent_too(tmp_path, monkeypatch):
    """For every angle its own; the domain is that of the passage."""
    table = tmp_path / "cam.csv"
    table.write_text("angle_deg, load_N_per_mm, R_mm, u_a_m_s, u_b_m_s\n-20, 116, 17, 2.0, 0.6\n0, 12, 17, 2.2, 0.7\n")
    seen = []
    monkeypatch.setattr(outcomes, "summaries", lambda scenes, *rest: seen.extend(scenes) or iter(()))
    tehl.cam(table, feature=Feature(shape="dent", height=-2e-6, width=0.2e-3, rim=0.3e-6), folder=tmp_path / "cam")
    assert len(seen) == 2 and all(cells(one) >= resolution.ENOUGH and one.grid.ny >= 64 for one in seen)
