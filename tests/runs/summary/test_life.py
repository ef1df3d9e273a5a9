"""Passages to initiation: closed form, error by the bar of the index, which index is taken, words and rows."""

import pytest

import tehl_taichi as tehl
from tehl_taichi.fatigue import judged_layers
from tehl_taichi.report import place_sections, verdict
from tehl_taichi.runs.flank.flank_columns import judged_index
from tehl_taichi.runs.summary import life, summary_rows
from tehl_taichi.runs.sweep.summary_columns import error_of, numbers
from tehl_taichi.values.coded_text import Reason, unknown_of

FATIGUE = tehl.scene("gear").replace(**{"fatigue.exponent": 9.0, "fatigue.limit_cycles": 2e6}).fatigue


def search(top, deep, error=0.01, **more):
    """Summary of a search with these indices at the surface and 25 um below."""
    below = {"Fi_max": deep, "depth_m": 25e-6, "error": {"Fi_max": error}}
    return {"Fi_max": top, "error": {"Fi_max": error}, "below": below, **more}


def test_twice_the_limit_takes_2_to_the_minus_9_of_its_passages():
    found = life.of_searches({"a": search(0.7, 2.0, 0.02), "b": search(1.9, 1.5)}, FATIGUE)
    assert found["passages"] == pytest.approx(2e6 / 512) and (found["surface"], found["depth_m"]) == ("a", 25e-6)
    assert found["error"]["passages"] == pytest.approx(2e6 * (1.98**-9 - 2.0**-9))
    assert found["error"]["passages"] == pytest.approx(found["passages"] * 9 * 0.02 / 2, rel=0.06)
    assert life.of_searches({"a": search(1.0, 0.9)}, FATIGUE)["passages"] == 2e6


def test_the_bar_holds_every_index_within_that_of_the_index():
    found = life.of_searches({"a": search(1.3, 1.2, 0.05)}, FATIGUE)
    for Fi in (1.25, 1.28, 1.35):
        assert abs(2e6 * Fi**-9.0 - found["passages"]) <= found["error"]["passages"] * (1 + 1e-12)


def test_an_error_as_large_as_the_number_is_an_interval():
    """The number of passages at both ends of the bar of the index; never a number below zero."""
    found = life.of_searches({"a": search(1.25, 0.5, 0.15)}, FATIGUE)
    assert found["error"]["passages"] > found["passages"]
    ends = f"{2e6 * 1.4**-9.0:.2g} to {2e6 * 1.1**-9.0:.2g}"
    assert life.words(found).startswith(f"after {ends} passages") and summary_rows.life_rows({"life": found})[0][1] == ends


@pytest.mark.parametrize("error", [None, 1.4])
def test_without_a_bar_of_the_index_that_of_the_passages_is_unknown(error):
    reason = unknown_of({"Fi_max": Reason("exit not resolved", "exit")}) if error is None else {}
    found = life.of_searches({"a": search(1.3, 1.2, error, **reason)}, FATIGUE)
    assert found["error"] == {"passages": None}
    assert ("exit not resolved" in str(found.get("unknown"))) == (error is None)


def test_none_without_an_exponent_or_an_index():
    assert life.part({"a": search(1.3, 1.2)}, tehl.scene("gear").fatigue) == {}
    assert life.part({}, FATIGUE) == {} == life.part({"a": search(-0.1, -0.2)}, FATIGUE)
    alone = {"Fi_max": None, "unknown": {"Fi_max": "too much friction"}, "pressure_alone": search(1.3, 1.2)}
    assert life.part({"a": alone}, FATIGUE) == {}


def test_of_rough_surfaces_it_is_that_of_the_percentile_and_an_averaged_index_leads_where_its_error_alone_is_known():
    rough = search(1.9, 1.8, rough=True, statistics={"p99": 1.1, "error": {"p99": 0.01}})
    assert life.of_searches({"a": rough}, FATIGUE)["Fi"] == 1.1
    wide = search(1.3, 0.5, None, averaged={"length_m": 1e-5, "Fi_max": 0.9, "error": {"Fi_max": 0.01}})
    assert life.of_searches({"a": wide}, FATIGUE)["Fi"] == 0.9


def test_it_is_said_and_printed_and_has_a_column_with_its_bar():
    above, below = (life.of_searches({"a": search(*both)}, FATIGUE) for both in ((0.7, 2.0), (0.5, 0.5)))
    assert verdict._life({"life": above})[0].startswith("Initiation 25 µm below surface a: after 3910 ± 180 passages")
    assert "below the limit, which stands for 2e+06 passages" in verdict._life({"life": below})[0]
    assert verdict._life({}) == ()
    (what, value), = summary_rows.life_rows({"life": above})
    assert what == "passages to initiation, exponent 9, at 25 um (a)" and value == "3910 ± 180"
    columns = numbers({"life": above})
    assert columns["life_passages"] == above["passages"] and error_of("life_passages") in columns


def test_of_rough_surfaces_the_worse_percentile_decides_also_below():
    deep = {"p99": 1.4, "depth_m": 7e-6, "error": {"p99": 0.01}}
    rough = search(1.9, 1.8, rough=True, statistics={"p99": 1.1, "error": {"p99": 0.01}})
    rough["below"]["statistics"] = deep
    found = life.of_searches({"a": rough}, FATIGUE)
    assert (found["Fi"], found["depth_m"]) == (1.4, 7e-6)


WIDE = {"length_m": 1e-5, "Fi_max": 0.7, "error": {"Fi_max": 0.01}, "below": {"Fi_max": 1.1, "depth_m": 9e-6,
                                                                              "error": {"Fi_max": 0.02}}}
EARLY = {"resolved": {**search(0.9, 0.95), "to_x_a": 0.5}}


@pytest.mark.parametrize("searches", [
    {"a": search(1.1, 1.3, None, **EARLY)}, {"a": search(1.1, 1.3, None, averaged=WIDE, **EARLY)},
    {"a": search(1.4, 1.3, None), "b": search(1.2, 1.1)}, {"a": search(0.9, 0.8, 0.2), "b": search(0.95, 0.9)},
    {"a": search(1.1, 1.3, None, **EARLY), "b": search(1.2, 1.1, None, resolved={**search(0.8, 0.97), "to_x_a": 0.5})}],
    ids=["resolved", "averaged", "known", "within", "other body"])
def test_they_are_those_of_the_index_that_the_verdict_judges(searches):
    """Of each kind of verdict, and where a larger index of another point does not decide."""
    found, summary = life.of_searches(searches, FATIGUE), {"fatigue": searches["a"], "fatigue_by_surface": searches}
    where, Fi, error = judged_layers.worst_layer(searches)
    assert (found["Fi"], error) == (Fi, judged_index(summary)[1]) and Fi == judged_index(summary)[0]
    assert found["passages"] == pytest.approx(2e6 * Fi**-9.0)
    assert found["error"]["passages"] == pytest.approx(2e6 * ((Fi - error) ** -9.0 - Fi**-9.0))
    assert found["resolved"] == judged_layers.deciding(searches)[1]
    assert ("averaged over" in where) == bool(found["length_m"]) == ("averaged over 10 µm" in verdict._life({"life": found})[0])


def test_of_a_resolved_part_they_are_an_upper_limit_and_tables_of_places_say_so():
    whole, part = (life.part({"a": search(1.1, 1.3, bar, **EARLY if bar is None else {})}, FATIGUE) for bar in (0.01, None))
    assert "can only lower the number" in verdict._life(part)[0] and "only lower" not in verdict._life(whole)[0]
    assert "while resolved" in summary_rows.life_rows(part)[0][0]
    said, = place_sections.passages([("A", 1e9, whole), ("C", 1e9, part), ("E", None, None)], str)
    assert "index that decides at each place; at C the grid" in said
    assert "resolve" not in place_sections.passages([("A", 1e9, whole)], str)[0]
    assert place_sections.passages([("A", 1e9, {}), ("E", None, None)], str) == ()


@pytest.mark.parametrize("Fi, error, earlier", [(1.2, 0.01, True), (0.94, 0.01, False), (0.96, 0.02, False),
                                                (1.2, None, False)])
def test_the_load_alone_is_said_where_it_initiates_a_crack_earlier(Fi, error, earlier):
    """As where a grid resolves the passage up to a part of the contact only, while the contact itself is known."""
    alone = {"Fi_max": Fi, "surface_Fi_max": 0.6, "depth_m": 180e-6, "error": {"Fi_max": error, "surface_Fi_max": error}}
    searches = {"a": search(1.1, 1.3, None, **EARLY), "b": search(1.0, 1.2, None, resolved={**search(0.8, 0.9), "to_x_a": 0.5})}
    found = life.of_searches({"a": searches["a"], "b": {**searches["b"], "contact_alone": alone}}, FATIGUE)
    assert found["Fi"] == 0.95 and ("contact_alone" in found) == earlier
    assert ("by the load alone, without any feature, 180 µm below surface b after" in life.words(found)) == earlier
    assert len(summary_rows.life_rows({"life": found})) == 1 + earlier
    if earlier:
        one = found["contact_alone"]
        assert one["passages"] == pytest.approx(2e6 * 1.2**-9.0)
        assert one["error"]["passages"] == pytest.approx(2e6 * (1.19**-9.0 - 1.2**-9.0))
