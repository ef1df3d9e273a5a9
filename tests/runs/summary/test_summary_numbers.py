"""Numbers of a summary by their names."""

import math

import pytest

from tehl_taichi.errors import UnknownName
from tehl_taichi.runs.summary import search_rows, summary_numbers

WHY = "no oil reaches this friction"
NO_VERDICT = {"steady": {"h_c_m": 4e-7, "error": {"h_c_m": 1e-9}},
              "fatigue": {"Fi_max": None, "unknown": {"Fi_max": WHY}, "error": {"Fi_max": None},
                          "pressure_alone": {"Fi_max": 0.4, "kappa_F": 0.3, "contact_alone": {"Fi_max": 1.2}}}}
STEADY = {"steady": {"h_c_m": 4e-7}, "contact_alone": {"Fi_max": 1.2, "depth_m": 1e-4},
          "contact_alone_by_surface": {"a": {"Fi_max": 1.2}}}


@pytest.mark.parametrize("name", ["Fi_max", "fatigue.Fi_max"])
def test_a_number_without_a_value_says_why(name):
    found = summary_numbers.find(NO_VERDICT, name)
    assert math.isnan(found.value) and found.error is None and found.reason == WHY and found.name == "fatigue.Fi_max"
    assert str(found) == f"no value ({WHY})"


def test_numbers_of_the_pressure_or_the_contact_alone_are_found_by_their_part():
    assert summary_numbers.find(NO_VERDICT, "fatigue.pressure_alone.Fi_max").value == 0.4
    assert summary_numbers.find(STEADY, "contact_alone.Fi_max").value == 1.2
    assert summary_numbers.find(STEADY, "contact_alone.depth").unit == "m"
    for summary, name in ((STEADY, "Fi_max"), (STEADY, "depth"), (NO_VERDICT, "kappa_F")):
        assert not summary_numbers.contains(summary, name)
        with pytest.raises(UnknownName, match=f"did you mean '.*alone.{name}'"):
            summary_numbers.find(summary, name)


def test_a_number_is_printed_by_any_format():
    found = summary_numbers.find(NO_VERDICT, "h_c")
    assert f"{found:.2e}" == "4.00e-07" and f"{found}" == str(found) and "±" in str(found)


def test_the_bar_of_a_stress_is_the_same_part_of_it_as_that_of_its_index():
    found = {"Fi_max": 1.2, "error": {"Fi_max": 0.06}, "findley_stress_max_Pa": 6e8}
    row = search_rows._judged_stress(found, "findley")
    assert row.error / row.number == pytest.approx(0.05)
