"""Numbers with a unit as text."""

import math

import pytest

from tehl_taichi.errors import SceneError
from tehl_taichi.values import units
from tehl_taichi.values.units import UNITS, in_unit

SAME = [("3.8 mm", "m", 3.8e-3), ("3.8mm", "m", 3.8e-3), ("1.5 µm", "m", 1.5e-6), ("1.5 um", "m", 1.5e-6),
        ("1 in", "m", 0.0254), ("1.9 GPa", "Pa", 1.9e9), ("-200 MPa", "Pa", -2e8), ("200 N/mm²", "Pa", 2e8),
        ("1100 N/mm", "N/m", 1.1e6), ("5 kN", "N", 5000.0), ("265 N m", "N m", 265.0), ("0.2 kNm", "N m", 200.0),
        ("343 K", "deg C", 69.85), ("70 °C", "deg C", 70.0), ("158 degF", "deg C", 70.0), ("220 cSt", "m2/s", 220e-6),
        ("86.8 mPa s", "Pa s", 0.0868), ("7.85 g/cm3", "kg/m3", 7850.0), ("47 W/(m K)", "W/mK", 47.0),
        ("22 1/GPa", "1/Pa", 22e-9),
        ("0.45 kJ/kgK", "J/kgK", 450.0), ("11.5 um/mK", "1/K", 11.5e-6), ("3 MPa sqrt(m)", "Pa sqrt(m)", 3e6),
        ("50 Hz", "1/min", 3000.0), ("3000 rpm", "1/min", 3000.0), ("100 pi", "m", None), ("-12 %", "-", -0.12),
        ("0.5 rad", "deg", math.degrees(0.5)), ("1500 rpm at 40 mm", "m/s", 2 * math.pi), ("10 rad/s at 0.1 m", "m/s", 1.0),
        ("850 cm/s", "m/s", 8.5), ("-2.5 a", "a", -2.5)]


@pytest.mark.parametrize("text, unit, expected", SAME, ids=[text for text, _, _ in SAME])
def test_a_number_with_its_unit(text, unit, expected):
    """Ordinary spellings, to the last digit."""
    if expected is None:
        with pytest.raises(SceneError, match="pi"):
            in_unit("key", text, unit)
    else:
        assert in_unit("key", text, unit) == pytest.approx(expected, rel=1e-14)


# by definition: one psi is a pound-force (0.45359237 kg at 9.80665 m/s2) on a square inch
EQUAL = [
    ("1 psi", f"{0.45359237 * 9.80665 / 0.0254**2!r} Pa", "Pa"), ("10 bar", "1 MPa", "Pa"), ("1 N/mm2", "1000 kPa", "Pa"),
    ("1 GPa", "1000 MPa", "Pa"), ("3.6 km/h", "100 cm/s", "m/s"), ("1000 um/s", "1 mm/s", "m/s"),
    ("1 m/s", "100 cm/s", "m/s"), ("1 cP", "1 mPa s", "Pa s"), ("1 ppm/K", "1 um/mK", "1/K"), ("1 1/K", "1e6 ppm/K", "1/K"),
    ("1 kg/l", "1 g/cm3", "kg/m3"), ("1 mm2/N", "1 1/MPa", "1/Pa"), ("1 1/MPa", "1000 1/GPa", "1/Pa"),
    ("1 cSt", "1 mm2/s", "m2/s"), ("1e6 cSt", "1 m2/s", "m2/s"), ("1 kN/mm", "1000 kN/m", "N/m"), ("1 kN/m", "1 N/mm", "N/m"),
    ("1 kN/m", "1000 N/m", "N/m"),
    ("1 J/gK", "1 kJ/kgK", "J/kgK"), ("1 kW/mK", "1000 W/mK", "W/mK"), ("1000 mN", "1 N", "N"), ("1 kN", "1000 N", "N"),
    ("1 kN m", "1e6 N mm", "N m"), ("1 N m", "1000 N mm", "N m"), ("60 rpm", "1 1/s", "1/min"), ("1 Hz", "1 1/s", "1/min"),
    ("60 1/min", f"{2 * math.pi!r} rad/s", "1/min"), ("180 deg", f"{math.pi!r} rad", "deg"), ("1 cm", "10 mm", "m"),
    ("1 um", "1000 nm", "m"), ("1 in", "2.54 cm", "m"), ("1 mm", "1000 um", "µm"), ("1 m", "1000 mm", "mm"),
    ("1 cm2", "100 mm2", "m2"), ("1 m2", "1e4 cm2", "m2"), ("1 cm3", "1000 mm3", "m3"), ("1 m3", "1e6 cm3", "m3"),
    ("1 K", "1000 mK", "K"), ("1 MPa sqrt(m)", "1e6 Pa sqrt(m)", "Pa sqrt(m)"), ("1 mPa s", "0.001 Pa s", "Pa s"),
    ("180 degrees", f"{math.pi!r} rad", "degrees"), ("1 kg/l", "1000 kg/m3", "kg/m3"), ("1 kJ/kgK", "1000 J/kgK", "J/kgK"),
    ("1 um/mK", "1e-6 1/K", "1/K"), ("1 1/GPa", "1e-9 1/Pa", "1/Pa"), ("50 %", "500e-1 %", "")]


@pytest.mark.parametrize("one, other, unit", EQUAL, ids=[f"{one} in {unit}" for one, _, unit in EQUAL])
def test_equal_sizes_in_two_units(one, other, unit):
    assert in_unit("key", one, unit) == pytest.approx(in_unit("key", other, unit), rel=1e-12)


def test_every_unit_is_compared_with_another():
    compared = {units.split(text)[1] for pair in EQUAL for text in pair[:2]}
    assert {name for table in UNITS.values() for name in table} - {"a", "b", "1/Pa2"} <= compared


def test_powers_of_ten_are_exact():
    """3.8 mm is the double 0.0038: a scene with units equals the scene without."""
    assert [in_unit("", f"{n}.3 um", "m") for n in range(1, 200)] == [float(f"{n}.3e-6") for n in range(1, 200)]
    assert in_unit("", "1.2e3 mm", "m") == 1.2


@pytest.mark.parametrize("text, unit, parts", [
    ("3.8 K", "m", ("'3.8 K'", "'K'", "m, cm, mm")), ("5 kN", "N/m", ("'kN'", "did you mean 'kN/m'", "N/mm")),
    ("3 mPa", "Pa", ("'mPa'", "MPa, GPa")), ("1500 rpm", "m/s", ("radius", "1500 rpm at 40 mm")),
    ("70 mm", "deg C", ("deg C, C, K",)),
    ("3 mm at 40 mm", "m", ("at 40 mm",)), ("1500 rpm at 40 kN", "m/s", ("'kN'", "m, cm, mm")),
    ("1 mm 2 mm", "m", ("'mm 2 mm'",)), ("3 x", "", ("'x'", "a number"))])
def test_another_unit_is_refused_in_one_sentence(text, unit, parts):
    with pytest.raises(SceneError) as caught:
        in_unit("contact.x", text, unit)
    assert str(caught.value).startswith("contact.x = ") and all(part in str(caught.value) for part in parts)


@pytest.mark.parametrize("value", ["abc", "1,5 mm", "", "mm", "3.8", "auto", 3.8, None, "nan mm", "0.5:2 mm"])
def test_what_is_no_number_with_a_unit_stays(value):
    """Whoever checks the value refuses it then."""
    assert in_unit("key", value, "m") is value


def test_every_declared_unit_has_its_own_name():
    """A value in the declared unit reads back as it is, whatever the quantity."""
    for unit in UNITS:
        if unit.strip("-"):
            assert in_unit("key", f"2 {unit}", unit) == 2.0, unit
