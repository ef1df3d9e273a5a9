"""Numbers with a unit as text."""

import math

import pytest

from tehl_taichi.errors import SceneError
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
