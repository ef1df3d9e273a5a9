"""Numbers of a summary by their names."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.errors import UnknownName
from tehl_taichi.runs.summary import search_rows, summary_numbers
from tehl_taichi.runs.summary import summary as summaries
from tehl_taichi.runs.sweep import summary_columns
from tehl_taichi.scene import scene
from tehl_taichi.values.estimate import Quantity

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


@pytest.mark.parametrize("name", [["h_c"], {"h_c": 1}, slice(0, 2), 3, None])
def test_a_name_that_is_no_text(name):
    assert not summary_numbers.contains(STEADY, name)
    with pytest.raises(UnknownName, match="is no number of this run"):
        summary_numbers.find(STEADY, name)


def test_areas_and_volumes_have_their_units():
    summary = {"fatigue": {"stressed": {"volume_m3": 2e-14, "area_m2": 3e-9, "track_equal_m2": 1e-6, "exponent": 20.0}}}
    found = {name.rpartition(".")[2]: one.unit for name, one in summary_numbers.all_numbers(summary).items()}
    assert found == {"volume_m3": "m3", "area_m2": "m2", "track_equal_m2": "m2", "exponent": ""}
    assert summary_numbers.find(summary, "volume").value == 2e-14
    assert summary_columns.unit_of("fatigue_stressed_area_m2") == "m2"


def test_a_number_is_printed_by_any_format():
    found = summary_numbers.find(NO_VERDICT, "h_c")
    assert f"{found:.2e}" == "4.00e-07" and f"{found}" == str(found) and "±" in str(found)


def test_the_bar_of_a_stress_is_the_same_part_of_it_as_that_of_its_index():
    found = {"Fi_max": 1.2, "error": {"Fi_max": 0.06}, "findley_stress_max_Pa": 6e8}
    row = search_rows._judged_stress(found, "findley")
    assert row.error / row.number == pytest.approx(0.05)


def test_the_film_over_the_roughness_has_the_relative_error_of_the_film():
    found = summaries._roughness(scene("rough"), {"h_c_m": 4e-7, "error": {"h_c_m": 2e-8}})
    assert found["error"]["lambda"] / found["lambda"] == pytest.approx(0.05)


def test_the_most_iterations_of_a_step_are_of_a_single_step():
    """Entries after 1, 3 and 4 steps."""
    series = {"step": [0, 1, 3, 4], "cycles": [90, 10, 30, 14], "newton": [9, 2, 4, 3], "rejected": [0, 0, 1, 0]}

    class Stored(SimpleNamespace):
        def __len__(self):
            return 4

    found = summaries._work(Stored(scalar=lambda name: np.array(series[name])))
    assert found["cycles_per_step_max"] == 15 and found["pressure_cycles"] == 144 and found["rejected_steps"] == 1


def test_a_relative_error_is_of_the_size_of_its_number():
    assert Quantity(-2e-4, 1e-5).relative == Quantity(2e-4, 1e-5).relative == pytest.approx(0.05)
    assert Quantity(0.0, 1e-5).relative is None is Quantity(1.0, None).relative
