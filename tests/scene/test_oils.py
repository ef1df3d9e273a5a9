"""The registry of named oils."""

import pytest
from tehl_cli.main import app
from typer.testing import CliRunner
from values.test_registry import hold

from tehl_taichi.scene import SceneError, scene
from tehl_taichi.scene.data_sheet import KEYS
from tehl_taichi.scene.named_oils import NAMED, NO_SOURCE, OILS, from_values
from tehl_taichi.scene.oil import Oil


@pytest.mark.parametrize("name", NAMED)
def test_every_named_oil_holds(name):
    hold(NAMED[name])
    oil = OILS[name]
    assert oil.name == name and oil.source == NAMED[name].source
    assert scene("gear").replace(**{"oil.name": name}).oil == from_values({"name": name}) == oil
    assert NAMED[name].numbers.keys() <= {*oil.law_numbers, "viscosity", "D1", "D2", "beta0", "expansion", *KEYS}


def test_the_reference_oil_is_that_of_scenes():
    """At 90 deg C log10 eta = 4.57 (5/3)^-1.25 - 4.2 = -1.7867."""
    assert OILS["reference-pao"] == Oil()
    assert NAMED["reference-pao"].viscosity(0.0, 90.0) == pytest.approx(10**-1.7867, rel=1e-4)


@pytest.mark.parametrize("name", OILS)
def test_an_oil_made_in_python_has_the_numbers_of_its_name(name):
    assert Oil(name=name) == Oil(name) == OILS[name] and Oil(name=name).source == OILS[name].source
    assert Oil(name=name, k0=0.2) == from_values({"name": name, "k0": 0.2})


def test_a_new_oil_made_in_python_has_not_the_source_of_the_reference_oil():
    assert Oil(name="mine", G0=4.5).source == NO_SOURCE
    sheet = {"nu_40": 220e-6, "nu_100": 19e-6}
    assert Oil(**sheet) == from_values(sheet) and Oil(**sheet).name == "data-sheet"


def test_a_known_name_with_another_data_sheet_has_its_own_source_in_python_and_in_files():
    sheet = {"nu_40": 1e-4, "nu_100": 1e-5}
    given = {"name": "mineral-vg220", **sheet}
    assert Oil(**given) == from_values(given) and Oil(**given).source.startswith("data sheet: 100 mm2/s at 40 deg C")
    assert Oil(**given, source="mine").source == from_values({**given, "source": "mine"}).source == "mine"
    for make in (from_values, lambda values: Oil(**values)):
        with pytest.raises(SceneError, match="'reference-pao' has its own viscosity"):
            make({"name": "reference-pao", **sheet})


@pytest.mark.parametrize("make", [lambda name: scene("gear").replace(**{"oil.name": name}), Oil,
                                  lambda name: Oil(name=name, source="mine"), lambda name: from_values({"name": name})])
def test_an_unknown_name_without_numbers_is_refused_with_those_that_are_known(make):
    with pytest.raises(SceneError, match=", ".join(NAMED)):
        make("nujol")


@pytest.mark.parametrize("name, grade", [("mineral-vg68", 68), ("mineral-vg100", 100), ("mineral-vg150", 150),
                                         ("mineral-vg460", 460), ("mineral-vg100-steep", 100),
                                         ("mineral-vg220", 220), ("mineral-vg320", 320)])
def test_a_grade_in_a_name_is_that_of_iso_3448(name, grade):
    """Within 10 % of the grade in mm2/s at 40 deg C, for any density that such an oil can have."""
    for density in (850.0, 880.0):
        assert NAMED[name].viscosity(0.0, 40.0) / density * 1e6 == pytest.approx(grade, rel=0.1)


def test_the_steep_oil_thins_faster_with_temperature():
    even, steep = (NAMED[name] for name in ("mineral-vg100", "mineral-vg100-steep"))
    assert steep.viscosity(0.0, 100.0) < 0.8 * even.viscosity(0.0, 100.0)


@pytest.mark.parametrize("name", NAMED)
def test_alpha_is_the_rise_with_pressure_at_none(name):
    oil = NAMED[name]
    rise = (oil.viscosity(2e6, 40.0) / oil.viscosity(0.0, 40.0) - 1) / 2e6
    assert oil.alpha(40.0) == pytest.approx(rise, rel=0.03)  # of Roelands': alpha^2 p/2 and Z are left


def test_alpha_of_a_law_that_has_it_is_that_number():
    fluid = NAMED["moes-test-fluid"]
    assert fluid.alpha(40.0) == pytest.approx(fluid.oil.alpha, rel=1e-6)


def test_the_list_has_numbers_of_the_laws():
    done = CliRunner(env={"COLUMNS": "100"}).invoke(app, ["oils"])
    row, = [line for line in done.stdout.splitlines() if "reference-pao" in line and "\u2502" in line]
    table = [line for line in done.stdout.splitlines() if "\u2502" in line]
    oil = NAMED["reference-pao"]
    assert NAMED["ridge-test-fluid"].shown_numbers[0] == "1220"
    for number in (oil.viscosity(0.0, 40.0) * 1e3, oil.viscosity(0.0, 100.0) * 1e3, oil.alpha(40.0) * 1e9):
        assert f" {number:.3g} " in row
    assert max(map(len, table)) <= 100 and f"reference-pao: {oil.oil.source}" in done.stdout


def test_the_nearest_name_of_an_oil_has_the_same_beginning():
    """vg10 is as near to vg100 as to vg150: the first is meant."""
    with pytest.raises(SceneError, match="did you mean 'mineral-vg100'"):
        scene("gear").replace(**{"oil.name": "mineral-vg10"})
