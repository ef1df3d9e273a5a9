"""What is known where a grid does not resolve all pressures: the moments before that, their search, bars and words."""

from types import SimpleNamespace

import made_results
import numpy as np
import pytest
from made_results import fatigue
from rolling import BothSides, Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment
from tehl_taichi.fatigue.search_result import PART, SearchResult
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.report import scene_text, verdict
from tehl_taichi.runs import zoom_need
from tehl_taichi.runs.summary import result_warnings, summary, summary_rows
from tehl_taichi.runs.sweep import summary_columns
from tehl_taichi.values.coded_text import Reason

INDICES = (coarse_runs.FI, coarse_runs.BELOW, coarse_runs.RESOLVED, coarse_runs.RESOLVED_BELOW)
GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "srr": 0.0, "fatigue.surfaces": "a"})


@pytest.mark.parametrize("changes", [{}, {"thermal.on": True}, {"fatigue.depths": [30e-6]}, {"feature.y": 0.25e-3},
                                     {"fatigue.depths": []}])
def test_the_early_moments_are_those_of_a_search_up_to_there(taichi_cpu, changes):
    scene = GEAR.replace(**changes)
    reader = Rolling(scene, 8, 5)
    both, whole = assessment.run(scene, reader, until=-0.3), assessment.run(scene, reader)
    early, alone = both.summary.pop("resolved"), assessment.run(scene.replace(**{"fatigue.to_x": -0.3}), reader)
    part = alone.summary
    assert early.pop("to_x_a") == -0.3
    assert both.summary["Fi_max"] == whole.summary["Fi_max"]
    if not changes.get("feature.y"):  # else the row of the early worst point is one more to look under
        assert both.summary == whole.summary
    deep, other = early.pop("below", {}), part.get("below", {})
    assert early == {key: pytest.approx(part[key], rel=1e-9) for key in early} and early["Fi_max"] < whole.summary["Fi_max"]
    assert deep == {key: pytest.approx(other[key], rel=1e-9) for key in deep} and bool(deep) == bool(other)
    maps = {name.removeprefix(PART): values[0] for name, values in both.maps.items() if name.startswith(PART)}
    own = set(alone.maps) & {"Fi", "worst_stress", "worst_below_normal", "worst_depth", "findley_stress_at_worst_depth",
                             "findley_stress_at_depth", "findley_stress_under_row"}
    assert "Fi" in own and own <= set(maps)
    for name, values in maps.items():
        np.testing.assert_allclose(values, alone.maps[name][0], atol=1e-9 * np.nanmax(np.abs(values)), err_msg=name)


def test_on_a_whole_domain_the_early_plane_is_at_the_worst_depth_of_the_early_moments(taichi_cpu):
    """Its stresses, too; all moments are worse at another depth."""
    reader = BothSides(GEAR, 8, 5)
    both = assessment.run(GEAR, reader, until=-0.3, alone=False)
    alone = assessment.run(GEAR.replace(**{"fatigue.to_x": -0.3}), reader, alone=False)
    early = both.resolved
    assert early.worst_depth == pytest.approx(alone.worst_depth) and early.worst_depth != pytest.approx(both.worst_depth)
    np.testing.assert_allclose(early.findley_stress_at_worst_depth, alone.findley_stress_at_worst_depth, rtol=1e-5)
    assert early.findley_stress_at_worst_depth.max() < 0.99 * both.findley_stress_at_worst_depth.max()


@pytest.mark.parametrize("until", [None, -3.0, 3.0])
def test_no_part_where_nobody_asks_or_it_is_nothing_or_all(taichi_cpu, until):
    assert "resolved" not in assessment.run(GEAR, Rolling(GEAR), until=until).summary


class Peaked(Rolling):
    """With a free edge of pressure, a cell wide, at X = 0.8 while the feature is at `at` (a)."""

    def __init__(self, scene, at):
        super().__init__(scene, 16, 3)
        self.at = at

    def fields(self, n, names):
        found = super().fields(n, ("pressure",))
        found["film"] = 1e-6 + 0 * found["pressure"]
        if abs(self.centres[n] / self.s.a - self.at) < 0.5 / 16:
            found["pressure"][int(np.searchsorted(self.x, 0.8 * self.s.a))] = 6e9
        return {name: found[name] for name in names}

    def scalar(self, name):
        pressures = [self.fields(n, ("pressure",))["pressure"].max() for n in range(len(self))]
        return np.array(pressures) if name == "p_max_Pa" else np.ones(len(self))


def test_the_resolved_part_ends_before_the_first_peak_that_is_not():
    late, never = Peaked(GEAR, 1.0), Peaked(GEAR, 9.0)
    until, first = coarse_runs.resolved(GEAR, late, late.scalar), int(np.argmax(late.scalar("p_max_Pa")))
    assert until == pytest.approx(late.feature_x(first - 1) / late.s.a) and 1 - 2 / 16 < until < 1
    assert coarse_runs.resolved(GEAR, never, never.scalar) is None


def test_moments_of_low_pressure_are_not_looked_at():
    """A peak below two thirds of the largest cannot overtake it."""
    reader, read = Peaked(GEAR, 1.0), []
    p, fields = reader.scalar("p_max_Pa"), reader.fields
    reader.fields = lambda n, names: read.append(n) or fields(n, names)
    coarse_runs.resolved(GEAR, reader, lambda name: p)
    assert read and all(p[n] >= p[1:].max() / 1.5 for n in read) and len(read) < len(p) / 2


def test_its_numbers_are_not_in_doubt():
    reader = Peaked(GEAR, 1.0)
    search = {**fatigue(), "resolved": {"to_x_a": 0.6, **fatigue(0.8, 0.9)}}
    own = coarse_runs.passage_readings(GEAR, reader, reader.scalar, {"b": search})
    of_b = {name: own[coarse_runs.of_surface("b", name)] for name in INDICES}
    assert of_b["Fi_max"].doubt and of_b[coarse_runs.BELOW].doubt
    part, below = of_b[coarse_runs.RESOLVED], of_b[coarse_runs.RESOLVED_BELOW]
    assert (part.value, below.value, part.doubt, below.doubt) == (0.8, 0.9, "", "")


def test_companions_search_up_to_where_the_run_is_resolved(taichi_cpu):
    """Asked for once they have marched; on a grid that resolves everything itself."""
    coarse = GEAR.replace(**{"grid.nx": 64, "grid.ny": 16, "fatigue.depths": []})
    asked = []
    found = coarse_runs.values(coarse, until=lambda: asked.append(1) or -0.5)
    part, whole = (coarse_runs.of_surface("a", name) for name in (coarse_runs.RESOLVED, coarse_runs.FI))
    assert asked == [1] and 0 < found[part].value < found[whole].value
    assert part not in coarse_runs.values(coarse.replace(**{"time.steps": 4}))


def test_the_summary_and_the_table_have_it():
    search = {**fatigue(), "resolved": {"to_x_a": 0.6, **fatigue(0.8, 0.9)}}
    *_, (part, names), (deep, below) = summary._parts({"transient": {}, "fatigue_by_surface": {"a": search}})
    assert part is search["resolved"] and names == {"Fi_max": "a:" + coarse_runs.RESOLVED}
    assert deep is part["below"] and below == {"Fi_max": "a:" + coarse_runs.RESOLVED_BELOW}
    part["error"], part["unknown"] = {"Fi_max": 0.02}, {}
    rows = dict(summary_rows.fatigue_rows(search))
    assert list(rows)[2] == "Fi_max while resolved (to 0.60 a)"
    assert rows["at x, y (as feature.x, feature.y), below while resolved"]
    assert "Fi_max at the surface, whole passage" in rows and "Fi_max below the surface, at 25 um, whole passage" in rows
    assert list(dict(summary_rows.fatigue_rows(fatigue())))[:3] == [
        "Fi_max of the smooth contact, at 180 um", "Fi_max of the smooth contact at the surface", "Fi_max at the surface"]
    assert rows["Fi_max while resolved (to 0.60 a)"] == "0.800 ± 0.020"
    assert rows["below the surface while resolved, at 25 um"] == "0.9 (error unknown)"
    assert summary_columns.error_of("fatigue_resolved_Fi_max") in summary_columns.numbers({"fatigue": search})
    assert summary_columns.error_of("fatigue_below_Fi_max") == "fatigue_below_error_Fi_max"
    assert summary_columns.error_of("lambda") == "error_lambda"
    for part in ("fatigue_statistics", "fatigue_by_surface_a_below_statistics", "contact_alone", "fatigue_contact_alone",
                 "fatigue_by_surface_b_below", "transient"):
        assert summary_columns.error_of(f"{part}_Fi_max") == f"{part}_error_Fi_max"


def test_a_smooth_contact_that_is_worst_at_its_surface_has_one_row():
    deep = {"Fi_max": 1.2, "surface_Fi_max": 0.7, "depth_m": 180e-6}
    for alone, count in ((deep, 2), ({**deep, "Fi_max": 0.7, "depth_m": 0.0}, 1)):
        rows = dict(summary_rows.fatigue_rows({**fatigue(), "contact_alone": alone}))
        assert len([what for what in rows if "smooth contact" in what]) == count
        assert rows["Fi_max of the smooth contact at the surface"] == "0.7 (error unknown)"


def test_one_reason_is_said_once(monkeypatch):
    monkeypatch.setattr(zoom_need, "work", lambda store, factor: 1.3 * factor)
    why = {"Fi_max": Reason("exit not resolved: a narrow peak", "exit")}
    told = {"transient": {"unknown": {"p_max_Pa": why["Fi_max"], "h_min_m": "it still changes"}},
            "fatigue": {"unknown": why, "resolved": {"unknown": why, "below": {"unknown": why}}}}
    assert list(result_warnings.unknown_errors(SimpleNamespace(scene=GEAR), told)) == [
        "the error of passage p_max, Fi_max, Fi_max of the resolved part, Fi_max below the surface of the resolved part "
        "is not known: exit not resolved: a narrow peak; try a grid that is finer along x: --grid 512x64 (4 times the work)"
        ", or --zoom 4 (6 times the work)",
        "the error of passage h_min is not known: it still changes"]


@pytest.mark.parametrize("part, error, whole, tone, said", [
    (1.2, 0.1, 1.6, "yes", "Yes: the fatigue limit is exceeded at the surface, even without the pressures"),
    (1.2, None, 1.6, "yes", "Probably yes: the fatigue limit is exceeded at the surface, even without the pressures that "),
    (0.98, 0.1, 1.6, "open", "Not decided: the index is 1 within its error at the surface, without the pressures that"),
    (0.8, 0.1, 1.6, "open", "Not decided: the index stays below 1 while the grid resolves the pressure, and"),
    (0.8, 0.1, 0.9, "no", "Probably not: the index stays below 1, but over the whole passage its error is unknown.")])
def test_the_answer_rests_on_what_is_known(part, error, whole, tone, said):
    before = {"to_x_a": 0.6, **fatigue(part, None), "error": {"Fi_max": error}}
    _, headline, found, tells = verdict.of_fatigue({**fatigue(whole, None), "error": {"Fi_max": None}, "resolved": before})
    assert found == tone and headline.startswith(said)
    assert tells[1] == ("While the grid resolves the pressure (feature up to 0.60 a, that is 0.60 half-widths behind the "
                        "middle of the contact; the rest can only add):") and f"Fi = {part}" in tells[2]
    assert tells[3] == "Over the whole passage, where the grid does not resolve the pressure:" and f"Fi = {whole}" in tells[4]


def test_an_index_that_is_one_within_its_error_later_may_exceed_one():
    before = {"to_x_a": 0.6, **fatigue(0.8, None), "error": {"Fi_max": 0.1}}
    for error, word in ((0.01, "exceeds"), (0.1, "may exceed")):
        found = {**fatigue(1.05, None), "error": {"Fi_max": error}, "resolved": before}
        assert verdict.of_fatigue(found)[1].endswith(f"while the grid resolves the pressure, and {word} 1 later.")


def test_a_cut_search_is_not_called_whole():
    part = GEAR.replace(**{"fatigue.from_x": -0.5, "fatigue.to_x": 0.7})
    before, over = {"to_x_a": 0.6, **fatigue(0.8, None)}, scene_text.when(part)
    assert over == "over all moments that count (feature from -0.5 a up to 0.7 a)"
    tells = verdict.of_fatigue({**fatigue(1.6), "resolved": {**before, "surface_angle_deg": 67.0}}, part)[-1]
    assert "is at 67° to the surface." in tells[-1] and "18 to 50° to the surface" in tells[-1]
    assert tells[3].startswith("Over all moments that count (feature from -0.5 a up to 0.7 a), where the grid does not")
    assert tells[0] == ("The smooth contact alone: Fi = 0.9 (error unknown) at 180 µm below surface a, below 1, and 0.6 "
                        "(error unknown) at surface a.")


def test_the_report_says_first_that_steel_would_yield():
    found = {"max_Pa": 2.9e9, "depth_m": 0.0, "surface": "a", "yield_stress_Pa": 2.2e9, "yields": True}
    summary = {"transient": {"p_max_Pa": 6.3e9}, "von_mises": found, "fatigue": {}}
    said, = verdict._yielding(summary, GEAR)
    assert "reaches 2.90 GPa at surface a" in said and said.endswith("the index is that of elastic bodies.")
    assert verdict._yielding({**summary, "von_mises": {**found, "yields": False}}, GEAR) == ()
    assert verdict._yielding({key: part for key, part in summary.items() if key != "fatigue"}, GEAR) == ()


def test_the_report_says_which_moments_count():
    part = GEAR.replace(**{"fatigue.to_x": 0.5})
    assert verdict._counted(GEAR) == ()
    assert verdict._counted(part) == ("Only moments with the feature up to 0.5 a count (fatigue.from_x, to_x).",)


def test_fatigue_of_a_run_is_told_apart_like_the_run(tmp_path, monkeypatch):
    """With other constants, up to the same position; a run that resolves everything has no such part."""
    asked = []
    monkeypatch.setattr(assessment, "run", lambda *args: asked.append(args[3]) or SearchResult(fatigue()))
    done = tehl.open(made_results.run(tmp_path / "made.zarr", search=fatigue()))
    for until in (-0.25, None):
        monkeypatch.setattr(coarse_runs, "resolved", lambda *_, until=until: until)
        done.fatigue(kappa=0.2)
    done.fatigue(until=0.5)
    monkeypatch.setattr(coarse_runs, "resolved", lambda *_: -0.25)
    tehl.fatigue(done, kappa=0.2)
    assert asked == [-0.25, None, 0.5, -0.25]


def test_steel_that_would_yield():
    store = SimpleNamespace(scene=GEAR)
    said, = result_warnings.yielding(store, {"steady": {"p_max_Pa": 1.9e9}, "transient": {"p_max_Pa": 4.7e9}})
    assert "p_max 4.70 GPa" in said and "about 4.6 GPa" in said
    assert list(result_warnings.yielding(store, {"steady": {"p_max_Pa": 1.9e9}, "transient": {"p_max_Pa": 4.5e9}})) == []
    assert result_warnings.yielding in result_warnings.CHECKS
