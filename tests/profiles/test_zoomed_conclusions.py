"""Conclusions by runs with a window: averaged stresses lead, errors that are not known decide nothing."""

import types

import numpy as np
import pytest
from tehl_taichi.profiles import conclusions, zoomed_conclusions
from tehl_taichi.profiles.passage_stresses import DEEP, DEPTHS

from tehl_taichi.errors import NotConverged
from tehl_taichi.scene import scene

CASE = "asperity 1.5 um, SRR -0.12"


def body(name, Fi, error, averaged=None):
    """Summary of a body's search: index, and below it twice that at 3 um."""
    def part(value):
        bar = {"error": {"Fi_max": error}} | ({} if error else {"unknown": {"Fi_max": "exit not resolved"}})
        return {"Fi_max": value, "findley_stress_max_Pa": value * 400e6, **bar}

    def both(value):
        return {**part(value), "below": {**part(2 * value), "depth_m": 3e-6}}

    return {"surface": name, **both(Fi), **({"averaged": both(averaged)} if averaged else {})}


def rows(tmp_path, monkeypatch, *bodies):
    """Rows of a run with these summaries, the worse first."""
    run = types.SimpleNamespace(summary={"fatigue_by_surface": {one["surface"]: one for one in bodies}})
    monkeypatch.setattr(zoomed_conclusions, "run_or_resume", lambda *given, **more: run)
    description = zoomed_conclusions._sized(conclusions.cases()[CASE], False, 4)
    assert description.zooms and description.zoom.factor == 4
    return zoomed_conclusions.rows(CASE, description, tmp_path)


def test_averaged_stresses_lead_and_bodies_come_in_order(tmp_path, monkeypatch):
    found = rows(tmp_path, monkeypatch, body("b", 1.4, None, 1.0), body("a", 0.9, 0.09))
    assert [row.body for row in found] == ["a", "b"]
    a, b = found
    assert a.values[("all", "whole")] == 360e6 and a.errors[("all", "whole")] == pytest.approx(36e6)
    assert b.values[("all", "whole")] == 400e6 and b.values[DEEP["whole"]] == 800e6
    assert np.isnan(b.errors[("all", "whole")]) and b.doubts[("all", "whole")] == "exit not resolved"
    assert b.values[DEPTHS[DEEP["whole"]]] == 3e-6 and b.grid == "256x64 zoom 4"


def test_rows_are_written_as_json_and_drawn(tmp_path, monkeypatch):
    """Depths have no error: the suite lost its results of two hours by that."""
    import matplotlib.pyplot as plt

    (row,) = rows(tmp_path, monkeypatch, body("a", 0.9, 0.09))
    found = conclusions.plain_row(row)["findley_stress_Pa"]
    assert found["all; whole"] == (360e6, pytest.approx(36e6))
    assert found["depth; whole"][0] == 3e-6 and np.isnan(found["depth; whole"][1])
    plt.close(conclusions.chart(plt, [row]))


def test_statements_are_those_of_the_whole_passage(tmp_path, monkeypatch):
    found = rows(tmp_path, monkeypatch, body("b", 1.0, 0.02), body("a", 0.9, 0.01))
    judged = {statement: verdict for statement, verdict, _ in zoomed_conclusions.verdicts(found, 400e6)}
    assert all("to 0.5 a" not in statement and "friction" not in statement for statement in judged)
    assert judged[f"the critical point lies below the surface: {CASE}; whole"] == "follows"
    assert judged[f"body b has a larger stress than body a (surface or below): {CASE}; whole"] == "follows"
    text = zoomed_conclusions.page(found, zoomed_conclusions.verdicts(found, 400e6), scene("gear"))
    assert f"| {CASE} | a | 256x64 zoom 4 | 360 ± 4 |  |  | 720 ± 4 at 3 um |" in text


def test_parts_of_the_load_count_in_runs_of_their_own(tmp_path, monkeypatch):
    """Each with its scene and store; statements about the slip are made of each part."""
    asked = {}

    def run(description, store, **more):
        asked[store.name] = description
        part = 0.5 if not description.fatigue.shear else 0.7 if not description.fatigue.thermal_stress else 1.0
        Fi = part * (1.0 if description.operation.srr < 0 else 1.2)
        return types.SimpleNamespace(summary={"fatigue_by_surface": {name: body(name, Fi, 0.01) for name in "ab"}})

    monkeypatch.setattr(zoomed_conclusions, "run_or_resume", run)
    both = {name: one for name, one in conclusions.cases().items() if name in zoomed_conclusions.BY_PARTS}
    monkeypatch.setattr(conclusions, "cases", lambda quick=False: both)
    found = zoomed_conclusions.run(tmp_path, 4)
    assert len(found) == 4 and len(asked) == 6
    row = next(one for one in found if one.name == CASE and one.body == "a")
    assert row.values[("pressure", "whole")] == 200e6 and row.errors[("no thermal stress", "whole")] == pytest.approx(4e6)
    judged = {statement: verdict for statement, verdict, _ in zoomed_conclusions.verdicts(found, 400e6)}
    assert judged["Fi(SRR -0.12) > Fi(SRR +0.12): asperity 1.5 um; pressure; whole"] == "does not follow"
    assert f"| {CASE} | a | 256x64 zoom 4 | 400 ± 4 | 280 ± 4 | 200 ± 4 | 800 ± 4 at 3 um |" in zoomed_conclusions.page(
        found, [], scene("gear"))


def test_a_run_that_does_not_converge_gives_its_reason(tmp_path, monkeypatch):
    def fail(*given, **more):
        raise NotConverged("it stops at 0.3 a")

    monkeypatch.setattr(zoomed_conclusions, "run_or_resume", fail)
    row, = zoomed_conclusions.rows(CASE, zoomed_conclusions._sized(conclusions.cases()[CASE], True, 2), tmp_path)
    assert row.reason == "it stops at 0.3 a" and row.grid == "32x8 zoom 2"
