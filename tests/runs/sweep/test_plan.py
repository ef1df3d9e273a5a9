"""What a sweep varies: values as they are typed, cases in order, what is refused before anything runs."""

import numpy as np
import pytest

from tehl_taichi.runs.sweep import axis_syntax, study_file
from tehl_taichi.runs.sweep.plan import Plan, plan, unit
from tehl_taichi.scene import SceneError, scene

GEAR = scene("gear").replace(**{"thermal.on": False})


@pytest.mark.parametrize("text, rows", [
    ("-0.3:0.3:7", [-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3]), ("0.5e-6,1e-6", [0.5e-6, 1e-6]), ("64:256:4", [64, 128, 192, 256]),
    ("-0.9:0.9:7", [-0.9, -0.6, -0.3, 0.0, 0.3, 0.6, 0.9]),
    ("1.0:100:3:log", [1.0, 10.0, 100.0]), ("eyring, newtonian", ["eyring", "newtonian"]), ("true,false", [True, False]),
    ("[1e-6, 2e-6],[3e-6]", [(1e-6, 2e-6), (3e-6,)]), ("0,1:2:3", [0, 1.0, 1.5, 2.0]), ("'a,b'", ["a,b"]),
])
def test_values_as_they_are_typed(text, rows):
    found = axis_syntax.axis_of(f"key={text}").rows
    assert [row[0] for row in found] == rows and [type(row[0]) for row in found] == [type(value) for value in rows]


LINE = scene("smooth-line").replace(**{"oil.name": "mineral-vg100"})


@pytest.mark.parametrize("key, text, values", [
    ("srr", "0:50%:3", [0.0, 0.25, 0.5]), ("srr", "0%:50 %:3", [0.0, 0.25, 0.5]), ("srr", "0:50:3 %", [0.0, 0.25, 0.5]),
    ("load", "500:1500 N/mm:3", [5e5, 1e6, 1.5e6]), ("load", "500kN/m:1.5 kN/mm:3", [5e5, 1e6, 1.5e6]),
    ("load", "500,1000,1500 N/mm", [5e5, 1e6, 1.5e6]), ("temperature", "40:120:3 °C", [40.0, 80.0, 120.0]),
    ("temperature", "313.15 K:120 degC:3", [40.0, 80.0, 120.0]), ("temperature", "40,80,393.15K", None),
    ("temperature", "40 °C, 353.15 K", [40.0, 80.0]), ("speed", "1:4:3:log m/s", [1.0, 2.0, 4.0]),
    ("speed", "600rpm at 0.05m:1200 rpm at 0.05m:2", [np.pi, 2 * np.pi]),
    ("hertz_pressure", "1GPa,1500:2000MPa:2", [1e9, 1.5e9, 2e9]),
    ("radius_x", "10:14:3mm", [0.010, 0.012, 0.014]), ("oil.alpha_40", "18:22:3 1/GPa", [18e-9, 20e-9, 22e-9]),
])
def test_ranges_and_lists_with_units(key, text, values):
    key = {"radius_x": "contact.radius_x"}.get(key, key)
    if values is None:
        values = [-233.15, -193.15, 120.0]  # one unit behind the last number holds for all: K
        with pytest.raises(SceneError, match="operation.temperature = -233.15"):
            plan(LINE, {key: text}).refused()
    assert plan(LINE, {key: text}).coordinate(key)[1] == pytest.approx(values, rel=1e-12)


def test_a_range_with_units_is_the_range_in_si():
    """Also as samples, in groups, and for the name of the study, by which a repeated command resumes."""
    assert plan(LINE, {"load": "500:1500:3 kN/m"}) == plan(LINE, {"load": "5e5:15e5:3"})
    assert plan(LINE, {"srr": "-30:30%"}, samples=5) == plan(LINE, {"srr": "-0.3:0.3"}, samples=5)
    found = axis_syntax.over_of(["srr=0:50%:3 temperature=40:120:3 °C"])
    together = plan(LINE, found)
    assert together.changes(1) == {"srr": 0.25, "temperature": 80.0}
    assert axis_syntax.over_of(["bodies.a.material=100Cr6,20MnCr5"]) == {"bodies.a.material": ["100Cr6", "20MnCr5"]}


@pytest.mark.parametrize("key, text, said", [
    ("load", "1kN:5:3", "5 has no unit; write 5 kN"), ("load", "1 kN/m,5", "5 has no unit"),
    ("load", "1,2 kN/m,5 kN/m", "1 has no unit"),
    ("srr", "0:50%:11 %", "one unit too many"), ("srr", "0:50 mm:3", "'mm' is no unit"), ("srr", "0:0.5:11x", "'x' is no unit"),
    ("load", "1 mm:5 kN:3", "not units of the same quantity"), ("temperature", "40 C:1 kN:3", "not units of the same"),
    ("load", "0:5kN/m:3:log", "positive ends"), ("load", "1:5kN/m", "load = 1000:5000 has no number of values"),
    ("load", "1:5kN:1", "2 to 100000"), ("srr", "0:0.5:5.5", "whole number"), ("srr", "0:0.5:11:lin", "is no range"),
    ("srr", "0:0.5:", "is no range"),
    ("srr", "0:0,5:11", "decimals need a point"), ("temperature", "40C:80C:3C:log", "is no range"),
])
def test_units_of_a_range_that_do_not_fit(key, text, said):
    with pytest.raises(SceneError, match=said):
        plan(LINE, {key: text}).refused()


def test_keys_that_change_together():
    found = axis_syntax.axis_of("srr=-0.1,0,0.1 speed=5:15:3")
    assert found.keys == ("srr", "speed") and found.rows == ((-0.1, 5), (0, 10), (0.1, 15))
    made = plan(GEAR, {("srr", "speed"): [(-0.1, 5), (0.1, 15)], "height": [1e-6, 2e-6]})
    assert made.dims == ("case",) and made.shape == (4,) and made.changes(2) == {"srr": 0.1, "speed": 15, "height": 1e-6}


@pytest.mark.parametrize("text, said", [
    ("srr", "must look like"), ("srr=", "must look like"), ("srr=0:1", "has no number of values"), ("srr=0,,1", "missing"),
    ("srr=0.1,0.1", "given twice"), ("speed=0:1:5:log", "positive ends"), ("speed=1:-1:5:log", "positive ends"),
    ("speed=1:0:5:log", "positive ends"), ("srr=0,1 speed=5:9", "speed = 5:9 has no number of values"),
    ("srr=0:1 speed=5,9", "srr = 0:1 has no number of values"), ("srr=0,1 speed=5", "srr has 2, speed has 1"),
    ("srr=0:1:0", "2 to 100000 values"), ("srr=1:0", "smaller than the second"),
])
def test_what_is_no_values_is_told(text, said):
    with pytest.raises(SceneError, match=said):
        axis_syntax.axis_of(text)


def test_cases_in_the_order_of_the_keys():
    made = plan(GEAR, {"srr": "-0.1:0.1:3", "feature.height": [0.5e-6, 1e-6]})
    assert made.dims == ("srr", "feature.height") and made.shape == (3, 2) and made.count == 6 and made.gridded
    assert [tuple(made.changes(n).values()) for n in (0, 1, 5)] == [(-0.1, 0.5e-6), (-0.1, 1e-6), (0.1, 1e-6)]
    assert made.case(5) == GEAR.replace(srr=0.1, height=1e-6) and made.coordinate("srr") == ("srr", [-0.1, 0.0, 0.1])
    assert Plan.from_text(made.text) == made and made.name == plan(GEAR, {"srr": "-0.1:0.1:3",
                                                                          "feature.height": [0.5e-6, 1e-6]}).name
    assert made.name != plan(GEAR, {"srr": "-0.1:0.1:3", "feature.height": [0.5e-6, 2e-6]}).name


@pytest.mark.parametrize("over, said", [
    ({"sr": [0.1]}, "did you mean 'srr'"), ({"feature.hight": [1e-6]}, "height"), ({"srr": [-2.0, 0.1]}, "never passes"),
    ({"height": [1e-6, 2.0]}, "height = 2 m"), ({"srr": [0.1], "operation.srr": [0.2]}, "swept twice"), ({}, "needs a key"),
    ({"load": [1e6], "hertz_pressure": [1e9]}, "contradict"), ({"srr": "0:1:400", "speed": "1:2:400"}, "at most 100000"),
    ({"srr": []}, "has no values"), ({("srr", "speed"): [(0.1, 5), (0.2,)]}, "needs 2 values"),
    ({("srr", "speed"): [0.1, 5]}, "needs 2 values"), ({("srr", "speed"): 5}, "needs 2 values"), ({3: [1]}, "has the key 3"),
    ({("srr", 3): [(0.1, 5)]}, r"has the key \['srr', 3\]; allowed: a name, as 'srr', or a tuple"),
])
def test_what_no_case_can_run_with_is_refused(over, said):
    with pytest.raises(SceneError, match=said):
        plan(GEAR, over).refused()


def test_a_corner_that_cannot_run_is_told_of_and_the_others_stay():
    made = plan(GEAR, {"grid.x_max": [1.5, 3.0], "height": [1e-6, 20e-6]})  # the higher one needs a wider grid
    found = made.refused()
    assert list(found) == [1] and "half-width" in found[1]


def test_samples_that_cannot_run_are_told_of_and_the_others_stay():
    """Each is the only one with its values, which is no mistake of a value."""
    made = plan(GEAR.replace(**{"grid.x_max": 1.5}), {"height": "1e-6:20e-6", "srr": "-0.3:0.3"}, samples=8)
    found = made.refused()
    assert 0 < len(found) < 8 and all("half-width" in why for why in found.values())
    assert max(made.changes(n)["height"] for n in range(8) if n not in found) < min(made.changes(n)["height"] for n in found)


def test_a_word_beside_a_number_is_no_end_of_an_interval():
    for pair in (("auto", -4.0), (-4.0, "auto")):
        made = plan(GEAR, {"grid.x_min": pair, "srr": "-0.3:0.3"}, samples=4)
        assert sorted(map(str, made.coordinate("grid.x_min")[1])) == ["-4.0", "-4.0", "auto", "auto"]


def test_a_latin_hypercube_has_a_sample_in_every_part():
    over = {"srr": (-0.3, 0.3), "speed": "2:40:log", "rheology.law": ["eyring", "newtonian"], "thermal.nodes": "5:13"}
    made = plan(GEAR, over, samples=20, seed=3)
    assert made.dims == ("case",) and made.count == 20
    columns = {key: made.coordinate(key)[1] for key in over}
    assert sorted(np.floor((np.array(columns["srr"]) + 0.3) / 0.03).astype(int)) == list(range(20))
    assert sorted(np.floor(20 * np.log(np.array(columns["speed"]) / 2) / np.log(20)).astype(int)) == list(range(20))
    assert np.ptp((np.array(columns["srr"]) + 0.3) / 0.03 % 1) > 0.5  # anywhere in its part
    assert columns["rheology.law"].count("eyring") == 10 and {type(value) for value in columns["thermal.nodes"]} == {int}
    assert plan(GEAR, over, samples=20, seed=3) == made != plan(GEAR, over, samples=20, seed=4)
    for wrong in ({"samples": 0}, {"samples": 2.5}, {"samples": 2, "seed": -1}):
        with pytest.raises(SceneError, match="whole number"):
            plan(GEAR, over, **wrong)


@pytest.mark.parametrize("over, samples, said", [
    ({"srr": 0.1}, 3, "srr = 0.1 is drawn twice among 3 samples"), ({"srr": [0.1, 0.1]}, 2, "drawn twice"),
    ({"srr": [1, 1.0]}, None, "srr = 1.0 is given twice"), ({"thermal.nodes": "5:7"}, 4, "nodes = [567] is drawn"),
    ({"srr": [0.1, 0.2], "rheology.law": ["eyring", "newtonian"]}, 5, "srr, rheology.law = 0.., .* is drawn twice"),
])
def test_equal_cases_of_equal_values_are_refused(over, samples, said):
    with pytest.raises(SceneError, match=said):
        plan(GEAR, over, samples=samples)


@pytest.mark.parametrize("typed, ends", [
    ("-30%:30%", ("-30%", "30 %")), ("-0.3:0.3", (-0.3, np.float32(0.3).astype(float).round(2))), ("-0.3:0.3", ("-0.3", 0.3)),
    ("-0.3:0.3", (np.array(-0.3), 0.3))])
def test_the_ends_of_an_interval_may_be_typed(typed, ends):
    assert plan(GEAR, {"srr": ends}, samples=5) == plan(GEAR, {"srr": typed}, samples=5)


@pytest.mark.parametrize("ends, said", [
    ((0.0, np.inf), "srr = inf must be finite"), ((np.nan, 0.1), "srr = nan is not a number"), ((10**400, 1), "out of range"),
    ((0.2, "0.1"), "0.2:0.1: the first end must be smaller"), ((0, "1 kN"), "operation.srr = '0 kN': 'kN' is no unit of it")])
def test_ends_that_are_none(ends, said):
    with pytest.raises(SceneError, match=said):
        plan(GEAR, {"srr": ends}, samples=2)


def test_two_words_are_choices():
    for two in (("eyring", "newtonian"), (True, False)):
        key = "rheology.law" if "eyring" in two else "thermal.on"
        assert plan(GEAR, {key: two}, samples=2, seed=1) == plan(GEAR, {key: list(two)}, samples=2, seed=1)


def test_a_sweep_has_one_name_whether_its_numbers_have_a_point():
    whole, pointed, other = (plan(GEAR, {"speed": values}) for values in ([5, 10], np.array([5.0, 10.0]), [5, 11]))
    assert whole.name == pointed.name != other.name and whole == pointed and pointed.matches(whole.text)


def test_a_masked_value_is_no_value():
    with pytest.raises(SceneError, match="operation.srr = None is not a number"):
        plan(GEAR, {"srr": np.ma.array([0.1, 0.2], mask=[False, True])}).refused()


def test_samples_may_share_a_value_of_one_key():
    assert plan(GEAR, {"srr": 0.1, "speed": "1:2"}, samples=3).count == 3 and plan(GEAR, {"srr": 0.1}, samples=1).count == 1


def test_units_of_keys():
    keys = {"srr": "1", "height": "m", "speed": "m/s", "load": "N/m", "bodies.b.E": "Pa", "operation.u_a": "m/s",
            "rheology.law": "1", "feature.0.x": "m", "hertz_pressure": "Pa", "grid.nx": "1"}
    assert {key: unit(GEAR, key) for key in keys} == keys
    assert unit(scene("ball-on-disc"), "load") == unit(scene("ball-on-disc"), "contact.load") == "N"


def test_a_study_file(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text('scene = "gear"\n[set]\ngrid.nx = 64\n"grid.ny" = 16\n[over]\nsrr = "-0.1:0.1:3"\n'
                    "feature.height = [5e-7, 1e-6]\n[[together]]\nspeed = [5, 10]\ntemperature = [90, 100]\n")
    made = study_file.load(path)
    assert study_file.is_study_file(path) and made.keys == ("srr", "feature.height", "speed", "temperature")
    assert made.count == 12 and made.case(11).grid.nx == 64
    assert made.changes(11) == {"srr": 0.1, "feature.height": 1e-6, "speed": 10, "temperature": 100}
    path.write_text("samples = 5\n[over]\nsrr = \"-0.1:0.1\"\nspeed = [5, 10]\n")
    assert study_file.load(path).count == 5
    for text, said in (("ower = 1\n[over]\nsrr = [1]", "did you mean 'over'"), ("[over]\nsrr = 1", "must be a list"),
                       ("scene = 1\n[over]\nsrr = [1]", "scene = 1 must be text")):
        path.write_text(text)
        with pytest.raises(SceneError, match=said):
            study_file.load(path)


def test_warnings_of_the_scenes_are_those_of_their_runs():
    """Each kind once, as the first scene has it, with the number of these scenes; idle keys are counted elsewhere."""
    named = scene("smooth-line").replace(**{"oil.name": "mineral-vg220"})
    made = plan(named, {"speed": [1.0, 50.0, 100.0], "temperature": [40.0, 90.0]})
    runs = [one for n in range(made.count) for one in made.case(n).warnings() if one.code != "idle"]
    first = {one.code: one for one in reversed(runs)}
    counts = {code: sum(one.code == code for one in runs) for code in first}
    assert {"inlet", "oil"} <= counts.keys() and len(made.warnings()) == len(counts)
    for code, count in counts.items():
        assert any(one.startswith(f"{first[code]} ({count} of 6 cases") for one in made.warnings())


def test_of_many_cases_some_are_looked_at():
    made = plan(scene("smooth-line").replace(**{"oil.name": "mineral-vg220"}), {"srr": "0:0.1:250"})
    (sentence,) = made.warnings()
    assert sentence.endswith("(100 of 100 cases looked at)") and "oil.alpha_40" in sentence
