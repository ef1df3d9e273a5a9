"""Warnings are sentences with a code and numbers: in a scene, a summary, a store, another process."""

import io
import json
import pickle
from types import SimpleNamespace

import made_results
import pytest
from commands import here
from small_stores import store

import tehl_taichi as tehl
from tehl_taichi.errors import typed_options
from tehl_taichi.runs.bearing.ring_contacts import RINGS
from tehl_taichi.runs.sweep import sweeping
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.store.store import Store
from tehl_taichi.values.coded_text import Reason, grid_option, reasons_of, unknown_of, without_options
from tehl_taichi.values.coded_warning import (
    CodedWarning,
    Kinds,
    by_kind,
    coded_warning,
    counted,
    lists,
    texts,
    warnings_of_lists,
    with_data,
)


def test_a_check_gives_its_sentence_the_registry_its_code():
    found = coded_warning({lambda: [with_data("one of 3", count=3), "two"]: "a", lambda: ["two"]: "b"})
    assert found == ["one of 3", "two"] and [one.code for one in found] == ["a", "a"]
    assert [one.data for one in found] == [{"count": 3}, {}]


def test_they_come_back_from_lists_and_from_another_process():
    warnings = [CodedWarning("one", "a", {"x_m": 1.0}), CodedWarning("two", "b")]
    for back in (warnings_of_lists(*lists(warnings).values()), pickle.loads(pickle.dumps(warnings)),
                 warnings_of_lists(*map(json.loads, texts(warnings).values()))):
        assert back == warnings and [(one.code, one.data) for one in back] == [("a", {"x_m": 1.0}), ("b", {})]
    assert [(one, one.code) for one in warnings_of_lists(["old"], [], [])] == [("old", "")]


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


THIN = {"grid.nx": 64, "thermal.on": False, "speed": 0.3}


def test_warnings_name_arguments_in_python_and_options_on_the_command_line(tmp_path):
    """Whoever wrote the store: it keeps the options, and a page has words of its own."""
    scene = tehl.scene("smooth-line").replace(**THIN)
    run = tehl.run(scene, tmp_path / "a.zarr")
    film = next(one for one in run.warnings if one.code == "film")
    assert film in scene.warnings() and film.endswith("use grid.nx=128") and film in run.summary["warnings"]
    assert any("thermal.on=True" in what for what in run.summary["left_out"]) and run.summary["left_out"] == scene.left_out()
    for said in (run.warnings, run.summary["warnings"], run.summary["left_out"], [run._repr_html_()]):
        assert not any("--" in text for text in said)
    done = json.loads(here("show", run.path, "--json").stdout)
    assert "use --grid 128" in str(done["warnings"]) and "--thermal" in str(done["left_out"])
    assert done["warnings"] == [str(one) for one in run.store.warnings]
    with typed_options():
        assert run.summary == done and scene.warnings() == scene.typed_warnings != run.warnings
    assert [without_options(one) for one in run.warnings] == [without_options(one) for one in run.store.warnings]
    assert "a grid of 128 columns" in without_options(film)


SAID = {"left_out": ["temperatures (--thermal computes them)"],
        **lists([with_data("use --grid 64", grid_option(SimpleNamespace(one_dimensional=True), 64, 16))])}


def made_up(job, progress=None):
    return {"status": "converged", "reason": "", "seconds": 0.1, "summary": {"steady": {"h_c_m": 1e-7}, **SAID}}


def test_summaries_of_studies_and_contacts_name_arguments_and_are_stored_with_options(tmp_path):
    made = sweeping.run(plan(tehl.scene("gear"), {"srr": [0.1]}), tmp_path / "s.zarr", workers=1, work=made_up)
    bearing = tehl.Bearing(tmp_path, {"name": "6206", **{ring: {"p_Hertz_Pa": 1e9, "summary": SAID} for ring in RINGS}})
    for summary in (made.results()[0]["summary"], *(bearing.rings[ring]["summary"] for ring in RINGS)):
        assert summary["warnings"] == ["use grid.nx=64"]
        assert summary["left_out"] == ["temperatures (thermal.on=True computes them)"]
        assert summary["warning_data"] == [{"options": {"grid.nx=64": "a grid of 64 columns"}}]
    assert "use --grid 64" in (made.path / "cases.jsonl").read_text()
    with typed_options():
        assert made.results()[0]["summary"]["warnings"] == ["use --grid 64"] and bearing.rings["inner"]["summary"] == SAID


def test_progress_names_arguments_in_python(tmp_path):
    said = io.StringIO()
    tehl.run(tehl.scene("smooth-line").replace(**THIN), tmp_path / "a.zarr", progress=tehl.Lines(said))
    assert "use grid.nx=128" in said.getvalue() and "thermal.on=True computes them" in said.getvalue()
    assert "--" not in said.getvalue()


def test_a_summary_has_sentences_codes_and_numbers_in_one_order(tmp_path):
    scene = tehl.scene("furrow-line").replace(**{"grid.nx": 64, "time.steps": 1, "fatigue.on": False})
    run = tehl.run(scene, tmp_path / "cut.zarr")
    known, summary = run.warnings, run.summary
    assert [one.code for one in known] == summary["warning_codes"] and "friction" in summary["warning_codes"]
    assert list(known) == summary["warnings"] and [one.data for one in known] == summary["warning_data"]
    friction = known[summary["warning_codes"].index("friction")]
    assert friction.data["friction_coefficient_max"] > friction.data["limit"] == 0.2


def test_warnings_of_several_runs_by_kind():
    """The first sentence of each kind with its number of cases; sentences that are said elsewhere are left out."""
    few, many, other = CodedWarning("3 cells", "cells"), CodedWarning("9 cells", "cells"), CodedWarning("hot", "heat")
    summaries = [("A", lists([few, other])), ("B", lists([many, other])), ("C", None), ("D", lists([few]))]
    assert by_kind(summaries) == [{"3 cells": ["A", "D"], "9 cells": ["B"]}, {"hot": ["A", "B"]}]
    assert by_kind(summaries, leave=[few]) == [{"hot": ["A", "B"]}, {"9 cells": ["B"]}]
    assert counted(summaries, "4 cases", leave=["hot"]) == ["3 cells (3 of 4 cases, numbers of the first)"]


def test_reasons_keep_their_code_in_a_summary_and_older_summaries_have_none():
    reasons = {"p_max_Pa": Reason("exit not resolved: a peak", "exit"), "Fi_max": Reason("its place differs", "place")}
    part = json.loads(json.dumps(unknown_of(reasons)))
    assert part["unknown"] == {"p_max_Pa": "exit not resolved: a peak", "Fi_max": "its place differs"}
    back = reasons_of(part)
    assert back == reasons and [one.code for one in back.values()] == ["exit", "place"]
    old = reasons_of({"unknown": part["unknown"]})
    assert old == reasons and {one.code for one in old.values()} == {""}
    assert reasons_of({}) == {} and [one.code for one in reasons_of({"unknown": reasons}).values()] == ["exit", "place"]


def test_options_are_replaced_by_the_words_that_come_with_them():
    grid = grid_option(SimpleNamespace(one_dimensional=False), 512, 128)
    made = with_data(f"too coarse; {grid}", grid, cells=3)
    assert made.data == {"cells": 3, "options": {"--grid 512x128": "a grid of 512 × 128 cells"}}
    back, = warnings_of_lists(*map(json.loads, texts([made]).values()))
    assert without_options(back) == "too coarse; a grid of 512 × 128 cells"
    assert str(grid_option(SimpleNamespace(one_dimensional=True), 512, 128)) == "--grid 512"
    assert without_options("of an older store: --grid 512x128") == "of an older store: --grid 512x128"


def test_a_store_without_codes_opens_and_is_reported(tmp_path):
    """As version 0.8 wrote it."""
    def bare(values):
        return {key: bare(value) if isinstance(value, dict) else value for key, value in values.items()
                if key not in ("unknown_codes", "warning_codes", "warning_data")}

    path = made_results.run(tmp_path / "a.zarr", search=made_results.fatigue())
    with Store.write(path) as saved:
        summary = bare({key: value for key, value in saved.summary.items() if key != "store"})
        assert "unknown_codes" in saved.summary["steady"] and "unknown_codes" not in summary["steady"]
        saved._commit(summary=json.dumps(summary), warning_codes="[]", warning_data="[]")
    old = tehl.open(path)
    assert old.summary["steady"]["unknown"] == {"h_min_m": "no coarser grid"} and old["h_min"].reason
    assert [one.code for one in old.warnings] == [""] and tehl.report(path).exists()


def test_the_kind_of_a_warning_is_its_code_its_key_and_which_of_several_it_is():
    """Equal for another run with other numbers; a warning that comes again has the kind that it had."""
    k, kappa = (CodedWarning(f"{key} idle", "idle", {"key": key}) for key in ("bodies.a.k", "fatigue.kappa"))
    coarse = [CodedWarning(f"{n} cells", "cells") for n in (3, 5, 4, 6)]
    one, other = Kinds(), Kinds()
    first = [one.of(warning) for warning in (k, kappa, coarse[0], coarse[1])]
    assert len(set(first)) == 4 and one.of(coarse[1]) == first[-1]
    assert [other.of(warning) for warning in (kappa, coarse[2], coarse[3], k)] == [first[1], first[2], first[3], first[0]]
