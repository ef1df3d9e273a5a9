"""Warnings are sentences with a code and numbers: in a scene, a summary, a store, another process."""

import json
import pickle

import pytest
from small_stores import store

import tehl_taichi as tehl
from tehl_taichi.values.coded_warning import CodedWarning, coded_warning, lists, of_lists, texts, with_data


def test_a_check_gives_its_sentence_the_registry_its_code():
    found = coded_warning({lambda: [with_data("one of 3", count=3), "two"]: "a", lambda: ["two"]: "b"})
    assert found == ["one of 3", "two"] and [one.code for one in found] == ["a", "a"]
    assert [one.data for one in found] == [{"count": 3}, {}]


def test_they_come_back_from_lists_and_from_another_process():
    warnings = [CodedWarning("one", "a", {"x_m": 1.0}), CodedWarning("two", "b")]
    for back in (of_lists(*lists(warnings).values()), pickle.loads(pickle.dumps(warnings)),
                 of_lists(*map(json.loads, texts(warnings).values()))):
        assert back == warnings and [(one.code, one.data) for one in back] == [("a", {"x_m": 1.0}), ("b", {})]
    assert [(one, one.code) for one in of_lists(["old"], [], [])] == [("old", "")]


def test_a_scene_and_its_store_have_them(tmp_path):
    scene = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 4})
    cut = next(one for one in scene.warnings() if one.code == "cut")
    assert f"{cut.data['end_a']:.2f} a" in cut and f"{cut.data['whole_a']:.2f} a" in cut
    saved = store(tmp_path / "a.zarr")
    saved._commit(**texts(scene.warnings()))
    found = tehl.open(saved.path).warnings
    assert found == scene.warnings() and [one.data for one in found] == [one.data for one in scene.warnings()]
    for wrong in ("[3]", "[null]"):
        saved._commit(warning_codes=wrong)
        with pytest.raises(tehl.StoreError, match="'warning_codes' holds"):
            tehl.open(saved.path)


def test_a_summary_has_sentences_codes_and_numbers_in_one_order(tmp_path):
    scene = tehl.scene("furrow-line").replace(**{"grid.nx": 64, "time.steps": 1, "fatigue.on": False})
    run = tehl.run(scene, tmp_path / "cut.zarr")
    known, summary = run.warnings, run.summary
    assert [one.code for one in known] == summary["warning_codes"] and "friction" in summary["warning_codes"]
    assert list(known) == summary["warnings"] and [one.data for one in known] == summary["warning_data"]
    friction = known[summary["warning_codes"].index("friction")]
    assert friction.data["friction_coefficient_max"] > friction.data["limit"] == 0.2
