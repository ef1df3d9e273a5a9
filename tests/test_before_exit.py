"""What is known before a feature leaves, where its exit is not resolved: the moments that count, the search, bars, words."""

import numpy as np
import pytest
from made_results import fatigue
from rolling import Rolling

import tehl_taichi as tehl
from tehl_taichi.fatigue import assessment
from tehl_taichi.io import result_judge, summary, summary_rows
from tehl_taichi.march import companions
from tehl_taichi.report import verdict
from tehl_taichi.scene import route
from tehl_taichi.scene.scales import Scales
from tehl_taichi.study import flat

GEAR = tehl.scene("gear").replace(**{"thermal.on": False, "srr": 0.0})


def test_a_feature_leaves_when_its_front_or_its_oil_comes_to_the_edge():
    reach = GEAR.features[0].reach / Scales.of(GEAR).a
    assert route.leaving(GEAR) == route.leaving(GEAR.replace(srr=0.2)) == pytest.approx(1 - reach)
    assert route.leaving(GEAR.replace(srr=-0.2)) == pytest.approx(2 * 0.9 - 1 - reach)  # oil is faster by 1/0.9
    assert route.leaving(GEAR.replace(**{"feature.x": 1e-4})) == pytest.approx(1 - reach - 1e-4 / Scales.of(GEAR).a)
    assert GEAR.path[0] < route.leaving(GEAR.replace(srr=-1.99)) == pytest.approx(-0.99 - reach)


@pytest.mark.parametrize("changes", [{}, {"thermal.on": True}, {"fatigue.depths": [30e-6]}, {"feature.y": 0.25e-3},
                                     {"fatigue.depths": []}])
def test_the_early_moments_are_those_of_a_search_up_to_there(taichi_cpu, changes):
    scene = GEAR.replace(**changes)
    reader = Rolling(scene)
    both, whole = assessment.run(scene, reader, until=-0.3), assessment.run(scene, reader)
    early = both.summary.pop("before_exit")
    part = assessment.run(scene.replace(**{"fatigue.to_x": -0.3}), reader).summary
    assert early.pop("to_x_a") == -0.3
    assert both.summary["Fi_max"] == whole.summary["Fi_max"]
    if not changes.get("feature.y"):  # else the row of the early worst point is one more to look under
        assert both.summary == whole.summary
    deep, other = early.pop("below", {}), part.get("below", {})
    assert early == {key: pytest.approx(part[key], rel=1e-9) for key in early} and early["Fi_max"] < whole.summary["Fi_max"]
    assert deep == {key: pytest.approx(other[key], rel=1e-9) for key in deep} and bool(deep) == bool(other)


@pytest.mark.parametrize("until", [None, -3.0, 3.0])
def test_no_part_where_nobody_asks_or_it_is_nothing_or_all(taichi_cpu, until):
    assert "before_exit" not in assessment.run(GEAR, Rolling(GEAR), until=until).summary


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


def test_moments_are_told_apart_where_the_exit_is_not_resolved():
    late, never = Peaked(GEAR, 1.0), Peaked(GEAR, 9.0)
    assert companions.exit_begins(GEAR, late, late.scalar) == route.leaving(GEAR)
    assert companions.exit_begins(GEAR, never, never.scalar) is None


@pytest.mark.parametrize("at, early", [(1.0, False), (0.2, True)])
def test_doubts_of_the_part_are_those_of_its_moments(at, early):
    reader = Peaked(GEAR, at)
    found = {**fatigue(), "before_exit": {"to_x_a": 0.6, **fatigue(0.8, 0.9)}}
    own = companions.passage_readings(GEAR, reader, reader.scalar, found)
    assert own["Fi_max"].doubt and own[companions.BELOW].doubt
    assert (own[companions.EARLY].value, own[companions.EARLY_BELOW].value) == (0.8, 0.9)
    assert bool(own[companions.EARLY].doubt) == bool(own[companions.EARLY_BELOW].doubt) == early


def test_the_summary_and_the_table_have_it():
    search = {**fatigue(), "before_exit": {"to_x_a": 0.6, **fatigue(0.8, 0.9)}}
    *_, (part, names), (deep, below) = summary._parts({"transient": {}, "fatigue": search})
    assert part is search["before_exit"] and names == {"Fi_max": companions.EARLY}
    assert deep is part["below"] and below == {"Fi_max": companions.EARLY_BELOW}
    part["error"], part["unknown"] = {"Fi_max": 0.02}, {}
    rows = dict(summary_rows.fatigue_rows(search))
    assert rows["before the exit (feature up to 0.60 a): Fi_max at the surface"] == "0.8000 ± 0.02"
    assert rows["before the exit (feature up to 0.60 a): below it, at 25 um"] == "0.9000 (error unknown)"
    assert flat.error_of("fatigue_before_exit_Fi_max") in flat.numbers({"fatigue": search})
    assert flat.error_of("fatigue_below_Fi_max") == "fatigue_below_error_Fi_max"


def test_one_reason_is_said_once():
    why = {"Fi_max": "exit not resolved"}
    told = {"transient": {"unknown": {"p_max_Pa": why["Fi_max"], "h_min_m": "it still changes"}},
            "fatigue": {"unknown": why, "before_exit": {"unknown": why, "below": {"unknown": why}}}}
    assert result_judge.unknown_errors(None, told) == [
        "the error of passage p_max_Pa, Fi_max, Fi_max before the exit, Fi_max below the surface before the exit is not known: "
        "exit not resolved", "the error of passage h_min_m is not known: it still changes"]


@pytest.mark.parametrize("part, error, whole, tone, said", [
    (1.2, 0.1, 1.6, "yes", "Yes: the fatigue limit is exceeded at the surface, before the feature leaves already."),
    (1.2, None, 1.6, "yes", "Probably yes: the fatigue limit is exceeded at the surface, before the feature leaves already; "),
    (0.98, 0.1, 1.6, "open", "Not decided: the index is 1 within its error at the surface, before the feature leaves"),
    (0.8, 0.1, 1.6, "open", "Not decided: the index stays below 1 until the feature leaves, and exceeds it at the exit"),
    (0.8, 0.1, 0.9, "no", "Probably not: the index stays below 1, as far as this grid resolves the exit;")])
def test_the_answer_rests_on_what_is_known(part, error, whole, tone, said):
    before = {"to_x_a": 0.6, **fatigue(part, None), "error": {"Fi_max": error}}
    _, headline, found, tells = verdict.of_fatigue({**fatigue(whole, None), "error": {"Fi_max": None}, "before_exit": before})
    assert found == tone and headline.startswith(said)
    assert tells[0] == "Before the feature leaves (its centre up to 0.60 a):" and f"Fi = {part}" in tells[1]
    assert tells[2] == "With the exit, which this grid does not resolve:" and f"Fi = {whole}" in tells[3]


def test_steel_that_would_yield():
    said, = result_judge.yielding(None, {"steady": {"p_max_Pa": 1.9e9}, "transient": {"p_max_Pa": 4.7e9}})
    assert "p_max 4.70 GPa" in said and "about 4 GPa" in said
    assert list(result_judge.yielding(None, {"steady": {"p_max_Pa": 1.9e9}, "transient": {"p_max_Pa": 3.9e9}})) == []
    assert result_judge.yielding in result_judge.CHECKS
