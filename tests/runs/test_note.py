"""The note of a scene: kept and shown with its run, told as a difference, and nothing more."""

import json

import made_results
import pytest
from read_pages import page
from small_stores import SMALL, store
from tehl_cli.main import app
from typer.testing import CliRunner

import tehl_taichi as tehl
from tehl_taichi.errors import SceneError
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import scene, scene_file

SAID = "scan of pinion 12, flank 3, after 2 h; \u00b5m and \"quotes\""
NOTED = SMALL.replace(note=SAID)


def test_a_scene_file_has_a_note(tmp_path):
    (tmp_path / "a.toml").write_text(f"base = \"gear\"\nnote = {scene_file.toml_value(SAID)}\n")
    noted = scene_file.load(tmp_path / "a.toml")
    assert noted.note == SAID and scene("gear").note == "" and noted.replace(srr=0.1).note == SAID
    (tmp_path / "b.toml").write_text(scene_file.dumps(noted))
    assert scene_file.load(tmp_path / "b.toml").note == SAID


@pytest.mark.parametrize("note, words", [("two\nlines", "note = .*on one line"), (3, "note = 3 must be text"),
                                         ("x" * 501, "501 characters; allowed: at most 500")])
def test_a_note_is_one_line(note, words):
    with pytest.raises(SceneError, match=words):
        SMALL.replace(note=note)


def test_it_makes_no_other_scene_and_no_other_study():
    """So that runs and studies go on when it was changed."""
    assert NOTED == SMALL and SMALL.replace(srr=0.1) != SMALL
    one, other = (plan(each, {"srr": [-0.1, 0.1]}) for each in (SMALL, NOTED))
    assert one.name == other.name and one.matches(other.text) and other.matches(one.text)
    assert not one.matches(plan(SMALL, {"srr": [-0.1, 0.2]}).text) and not one.matches("{}")
    without = json.loads(one.text)  # as before there were notes
    del without["scene"]["note"], without["scene"]["oil"]["nu_40"]
    assert one.matches(json.dumps(without))
    without["scene"]["oil"]["G0"] *= 1.01
    assert not one.matches(json.dumps(without))
    assert plan(SMALL.replace(srr=0.1), {"height": [1e-6]}).name != plan(SMALL, {"height": [1e-6]}).name


def test_show_and_the_report_tell_it(tmp_path):
    made_results.run(tmp_path / "a.zarr", NOTED)
    assert tehl.open(tmp_path / "a.zarr").scene.note == SAID
    done = CliRunner().invoke(app, ["show", str(tmp_path / "a.zarr")])
    assert done.exit_code == 0 and f"\nnote: {SAID}\n" in done.output
    pytest.importorskip("plotly")
    assert f"Note: {SAID}" in page(tehl.open(tmp_path / "a.zarr").store, tmp_path).text
    made_results.run(tmp_path / "b.zarr", SMALL)
    assert "note:" not in CliRunner().invoke(app, ["show", str(tmp_path / "b.zarr")]).output


def test_compare_tells_it_where_it_is_another_one(tmp_path):
    scenes = {"a": NOTED, "b": NOTED.replace(srr=0.1), "c": SMALL.replace(srr=0.1)}
    places = [store(tmp_path / f"{name}.zarr", 4, each) and tmp_path / f"{name}.zarr" for name, each in scenes.items()]
    assert "note" not in tehl.compare(*places[:2]).differs
    found = tehl.compare(places[0], places[2])
    assert found.differs == {"note": [SAID, ""], "operation.srr": [-0.12, 0.1]}
    assert found.labels() == ["srr = -0.12", "srr = 0.1"]
