"""What is said of a plan before it runs: keys without effect in some cases, and warnings of some of many cases."""

import pytest

from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.runs.sweep.repeated_cases import sentences
from tehl_taichi.scene import scene

LINE = scene("smooth-line")
LAWS = ["eyring", "limiting"]  # the second does not use tau_0


def test_one_repeated_case_is_named_several_are_counted_with_the_reason():
    (one,) = sentences(plan(LINE, {"rheology.law": LAWS, "rheology.tau_0": [1e6, 1e7]}))
    assert one.startswith("case 3 equals case 2")
    (many,) = sentences(plan(LINE, {"rheology.law": LAWS, "rheology.tau_0": "1e6:1e7:6"}))
    assert many.startswith("5 of 12 cases repeat earlier ones (case 7 equals case 6)")
    assert many.endswith("rheology.tau_0 (the shear law 'limiting' does not use it)")
    assert sentences(plan(LINE, {"rheology.law": LAWS, "srr": "0.1:0.2:6"})) == []


@pytest.mark.parametrize("keys", [("srr", "rheology.law", "rheology.tau_0"), ("rheology.tau_0", "srr", "rheology.law")])
def test_large_plans_say_it_too(keys):
    """Whichever key changes fastest; before, nothing was said beyond 100 cases."""
    values = {"srr": "0.1:0.2:5", "rheology.law": LAWS, "rheology.tau_0": "1e6:1e7:12"}
    made = plan(LINE, {key: values[key] for key in keys})
    (said,) = sentences(made)
    assert made.is_large and said.startswith("rheology.tau_0 has no effect in ") and "of 100 cases looked at" in said
    assert not sentences(plan(LINE, {"srr": "0.1:0.2:120"}))


def test_the_last_key_of_a_large_plan_is_looked_at():
    """Cases at equal distances would all have its first value."""
    oils = ["reference-pao", "mineral-vg220"]  # the second estimates its alpha
    made = plan(LINE.replace(srr=0.1), {"speed": "1:20:100", "oil.name": oils})
    assert {one.oil.name for one in made.scenes_looked_at()} == set(oils)
    assert any("oil.alpha_40" in one and "of 100 cases looked at" in one for one in made.warnings())


def test_a_set_key_that_some_cases_use_has_an_effect():
    """Not judged by the scene before the changes, whose law does not use it."""
    given = LINE.replace(**{"rheology.tau_0": 1e6})
    assert not plan(given, {"srr": "0.1:0.2:60", "rheology.law": LAWS}).doubts()
    assert plan(given, {"srr": "0.1:0.2:101"}).doubts()


def test_isothermal_cases_among_thermal_ones_of_a_large_plan():
    """Pure rolling of a slow contact computes no temperatures."""
    slow = scene("gear").replace(speed=0.5)
    made = plan(slow, {"srr": "0:0.2:101"})
    assert made.without_temperatures() == [number for number in range(101) if made.case(number).isothermal] != []
