"""Rows of the printed summary: the text of each is its number in its unit, and places and pairs are in their order."""

import re

import made_results
import pytest

from tehl_taichi.runs.summary.summary_rows import rows_of

FACTORS = {"mm": 1e3, "um": 1e6, "nm": 1e9, "GPa": 1e-9, "MPa": 1e-6, "%": 100, "mm2": 1e6}  # of printed units, from SI
NUMBER = r"-?\d+(?:\.\d+)?(?:e[+-]\d+)?"


def searched(surface, **more):
    """Summary of a search whose places, stresses and residual stresses all differ."""
    found = made_results.fatigue(1.21, 1.47)
    deep = {**found["below"], "x_m": -7e-6, "y_m": 21e-6, "tau_amp_Pa": 4.4e8, "sigma_n_max_Pa": 3.1e7,
            "residual_xx_Pa": -2.1e8, "residual_yy_Pa": -1.3e8, "sigma_eF_Pa": 4.6e8, "kappa_F": 0.25}
    statistics = {"share_above_1": 0.12, "median": 0.71, "p90": 1.02, "p99": 1.24, "points": 130, "cycles_above_1": 0.2}
    return {**found, "surface": surface, "x_m": 8e-6, "y_m": 13e-6, "below": deep, "statistics": statistics,
            "von_mises": {"max_Pa": 1.8e9, "yield_stress_Pa": 2.2e9, "depth_m": 9e-5, "surface": surface},
            "stressed": {"track_equal_m2": 3e-6, "track_equal_surface_m2": 7e-6, "failure_volume": 0.1, "failure_surface": 0.2},
            "by_depth": [{"depth_m": 5e-5, "findley_stress_max_Pa": 5.2e8}], **more}


def summary(**fatigue):
    steady = {"h_c_m": 4.1e-7, "h_min_m": 3.2e-7, "p_max_Pa": 1.31e9, "friction_coefficient": 0.051, "film_formula_m": 4.3e-7,
              "film_max_C": 121.0, "surface_a_max_C": 102.0, "surface_b_max_C": 99.0, "error": {"h_c_m": 1.2e-8}}
    transient = {"h_min_m": 1.4e-7, "p_max_Pa": 2.3e9, "friction_coefficient_mean": 0.047, "contact_load_fraction_max": 0.02,
                 "film_max_C": 150.0, "surface_a_max_C": 122.0, "surface_b_max_C": 111.0, "residual_max": 1e-6,
                 "load_error_max": 2e-4, "mass_error_max": 3e-5, "error": {"p_max_Pa": 4e7}}
    run_in = {"passages": 3, "rounds": 5, "shaken_down": True, "surface_change_max_m": 2.2e-8, "plastic_strain_max": 0.0123,
              "residual_min_Pa": -3.1e8, "residual_max_Pa": 1.4e8, "height_before_m": 1.5e-6, "height_after_m": 1.2e-6}
    heights = {"Sa_m": 2.1e-7, "Sq_m": 2.7e-7, "Sz_m": 1.9e-6, "skewness": -0.3, "Rq_slope": 0.021, "length_x_m": 2.4e-5,
               "length_y_m": 8.1e-5}
    return {"scene": "made up", "steps": 9, "store": "s", "wall_s": 12.5, "compile_s": 2.5, "steady": steady, "run_in": run_in,
            "hertz": {"a_m": 3.6e-4, "b_m": 5.2e-4, "p_Pa": 1.2e9}, "transient": transient, "roughness": {"a": heights},
            "peclet": {"a": 11.0, "b": 13.0}, "lambda": 1.52, "fatigue": searched("a", **fatigue),
            "zoom": {"factor": 4, "window_a": [0.5, 0.7], "base": {"p_max_Pa": 1.9e9, "h_min_m": 2.1e-7, "film_max_C": 140.0}}}


@pytest.mark.parametrize("rough", [False, True])
def test_the_text_of_a_row_is_its_number_in_its_unit(rough):
    rows = [row for row in rows_of(summary(rough=rough)) if isinstance(row.number, (int, float))]
    assert len(rows) > 35
    for row in rows:
        value = row.value.partition(" (")[0]
        said, unit = [float(one) for one in re.findall(NUMBER, value)], value.split()[-1]
        assert said[row.what.startswith("Sa / Sq")] == pytest.approx(row.number * FACTORS.get(unit, 1), rel=0.01), row


def test_the_numbers_of_rows_are_those_of_their_words():
    """Also where one row has several."""
    rows = dict(row.text_pair for row in rows_of(summary()))
    deep = dict(row.text_pair for row in rows_of(summary()) if row.part == "below it")
    top = dict(row.text_pair for row in rows_of(summary()) if row.part == "at the surface")
    assert rows["Hertz half-width a"] == "0.3600 mm" and rows["Hertz half-axis b, across"] == "0.5200 mm"
    assert rows["worst residual / load / mass error"] == "1.0e-06 / 2.0e-04 / 3.0e-05"
    assert rows["p_max / h_min / hottest film without the zoom"] == "1.9 GPa / 0.21 um / 140 °C"
    assert rows["passage film / surface a / surface b, largest"].startswith("150.0 / 122.0 / 111.0 °C")
    assert rows["plastic strain by run-in, largest"].startswith("1.23 %") and "(before 1.5)" in rows["height after run-in"]
    assert rows["autocorrelation length of surface a"] == "24 um along x, 81 um along y"
    assert rows["skewness / rms slope of surface a"] == "-0.30 / 0.021" and rows["Péclet number of surface a / b"] == "11 / 13"
    place, stresses = "at x, y (as feature.x, feature.y)", "shear amplitude, largest normal stress"
    assert (top[place], deep[place]) == ("8.0, 13.0 um", "-7.0, 21.0 um")
    assert (top[stresses], deep[stresses]) == ("400.0, 20.0 MPa", "440.0, 31.0 MPa")
    assert (top["with kappa, sigma_eF"], deep["with kappa, sigma_eF"]) == ("0.3, 400 MPa", "0.25, 460 MPa")
    assert deep["residual stress along x / y"] == "-210 / -130 MPa"
    assert rows["largest von Mises stress, at 90 um (a)"] == "1.8 GPa (error unknown), yield stress 2.2 GPa"


def test_percentiles_of_rough_surfaces_are_in_their_rows():
    rows = dict(row.text_pair for row in rows_of(summary(rough=True)))
    assert [rows[f"Fi surface, {name}"].split()[0] for name in ("99th percentile", "90th percentile", "median")] == [
        "1.24", "1.02", "0.71"]
    assert rows["share of the surface with Fi > 1"].startswith("12 %")
