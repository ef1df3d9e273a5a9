"""Numbers with a unit, as text: "3.8 mm", "343 K", "1500 rpm at 40 mm". One parser for files, options and Python."""

import math
import re

from tehl_taichi.errors import SceneError
from tehl_taichi.values import checks
from tehl_taichi.values.coerce import plain, shown

LENGTH = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "in": 25.4e-3}
PRESSURE = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/mm2": 1e6, "bar": 1e5, "psi": 6894.757293168361}
TURNS = {"1/min": 1.0, "rpm": 1.0, "1/s": 60.0, "Hz": 60.0, "rad/s": 30 / math.pi}  # 1/min
ANGLE = {"deg": 1.0, "degrees": 1.0, "rad": 180 / math.pi}
# {declared unit: {unit that people write: its size in the declared one}}
UNITS = {
    "m": LENGTH, "mm": {name: size * 1e3 for name, size in LENGTH.items()},
    "cm": {name: size * 1e2 for name, size in LENGTH.items()},
    "µm": {name: size * 1e6 for name, size in LENGTH.items()},
    "m2": {"m2": 1.0, "cm2": 1e-4, "mm2": 1e-6}, "m3": {"m3": 1.0, "cm3": 1e-6, "mm3": 1e-9},
    "Pa": PRESSURE, "1/Pa": {"1/Pa": 1.0, "1/MPa": 1e-6, "1/GPa": 1e-9, "mm2/N": 1e-6}, "1/Pa^2": {"1/Pa2": 1.0},
    "Pa sqrt(m)": {"Pa sqrt(m)": 1.0, "MPa sqrt(m)": 1e6},
    "N": {"N": 1.0, "kN": 1e3, "mN": 1e-3}, "N m": {"N m": 1.0, "kN m": 1e3, "N mm": 1e-3},
    "N/m": {"N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3, "kN/mm": 1e6},
    "m/s": {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3, "um/s": 1e-6, "km/h": 1 / 3.6}, "1/min": TURNS,
    "K": {"K": 1.0, "mK": 1e-3}, "1/K": {"1/K": 1.0, "um/mK": 1e-6, "ppm/K": 1e-6},
    "kg/m3": {"kg/m3": 1.0, "g/cm3": 1e3, "kg/l": 1e3}, "W/mK": {"W/mK": 1.0, "kW/mK": 1e3},
    "J/kgK": {"J/kgK": 1.0, "kJ/kgK": 1e3, "J/gK": 1e3},
    "m2/s": {"m2/s": 1.0, "mm2/s": 1e-6, "cSt": 1e-6}, "Pa s": {"Pa s": 1.0, "mPa s": 1e-3, "cP": 1e-3},
    "deg": ANGLE, "degrees": ANGLE, "-": {"%": 0.01}, "": {"%": 0.01}, "a": {"a": 1.0}, "b": {"b": 1.0}}
TEMPERATURES = {"deg C": lambda value: value, "C": lambda value: value, "K": lambda value: value - 273.15,
                "deg F": lambda value: (value - 32) / 1.8}
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
NAME = r"(?:(?<=\s)1/)?[^\d\s.,:;][^,:;]*?"
WITH_UNIT = re.compile(rf"\s*({NUMBER})\s*({NAME})(?:\s+at\s+({NUMBER})\s*({NAME}))?\s*")
BARE = re.compile(rf"\s*{NUMBER}\s*")
SPELLED = {"\u00b5": "u", "\u03bc": "u", "\u00b2": "2", "\u00b3": "3", "\u00b0": "deg", "^": "", "*": "", "\u00b7": "", "(": "",
           ")": "", " ": ""}


def in_unit(where, value, unit):
    """Number in `unit` from a text such as "3.8 mm"; other values are returned unchanged.

    A speed in m/s may be given as turns at a radius. Raises SceneError for a wrong unit.

    >>> in_unit("contact.radius_x", "3.8 mm", "m")
    0.0038
    >>> round(in_unit("operation.u_m", "1500 rpm at 40 mm", "m/s"), 4)
    6.2832
    >>> round(in_unit("operation.temperature", "343 K", "deg C"), 2)
    69.85
    """
    match = WITH_UNIT.fullmatch(value) if isinstance(value, str) and not BARE.fullmatch(value) else None
    if not match:
        return value
    digits, name, radius, of_radius = match.groups()
    turns = _named(name, TURNS) if unit == "m/s" else None
    if turns is not None:
        return _at_radius(where, value, turns * float(digits), radius, of_radius)
    if radius is not None:
        raise _refused(where, value, f"at {radius} {of_radius}", unit)
    return _converted(where, value, digits, name, unit)


def amount(where, value, unit, low=-math.inf, high=math.inf, **limits):
    """Number in `unit` of an argument: a number, also of numpy, a text with a unit, or a Quantity. Raises SceneError.

    low, high, limits: as for :func:`tehl_taichi.values.checks.number`.

    >>> amount("dx", "10 um", "m", 0.0, 1.0)
    1e-05
    """
    found = in_unit(where, plain(value), unit)
    checks.number(where, found, unit, low, high, **limits)
    return float(found)


def known(name, unit):
    """Whether numbers in `unit` may be written in the unit `name`."""
    return _named(name, TEMPERATURES if unit == "deg C" else UNITS.get(unit, {})) is not None


def split(text):
    """(number, unit) of "3.8 mm" or "3.8", as text; turns at a radius have the unit "rpm at 40 mm". None for other texts.

    >>> split("1500rpm at 40 mm"), split("3.8"), split("limiting")
    (('1500', 'rpm at 40 mm'), ('3.8', ''), None)
    """
    if BARE.fullmatch(text):
        return text.strip(), ""
    match = WITH_UNIT.fullmatch(text)
    if not match:
        return None
    digits, name, radius, of_radius = match.groups()
    return digits, name if radius is None else f"{name} at {radius} {of_radius}"


def in_same_unit(text, low, high):
    """(low, high, unit) in the unit of `high`, from two (number, unit) of :func:`split`; text: user's input. A low end without
    a unit has that of the high one. Raises SceneError.

    >>> in_same_unit("500N:2kN", ("500", "N"), ("2", "kN"))
    (0.5, 2.0, 'kN')
    """
    if low[1] and not high[1]:
        raise SceneError(f"{text}: {high[0]} has no unit; write {high[0]} {low[1]}, or both in SI units without a unit")
    if low[1] in ("", high[1]):
        return float(low[0]), float(high[0]), high[1]
    kinds = [table for table in UNITS.values() if all(_named(unit, table) is not None for _, unit in (low, high))]
    if kinds:
        return float(low[0]) * _named(low[1], kinds[0]) / _named(high[1], kinds[0]), float(high[0]), high[1]
    if any(_named(unit, TEMPERATURES) is None for _, unit in (low, high)):
        raise SceneError(f"{text}: {shown(low[1])} and {shown(high[1])} are not units of the same quantity")
    first, second = (_clean(_named(unit, TEMPERATURES)(float(digits))) for digits, unit in (low, high))
    return first, second, "deg C"


def _converted(where, value, digits, name, unit):
    if unit == "deg C":
        found = _named(name, TEMPERATURES)
        if found is not None:
            return _clean(found(float(digits)))
    elif (size := _named(name, UNITS.get(unit, {}))) is not None:
        return _scaled(digits, size)
    raise _refused(where, value, name, unit)


def _at_radius(where, value, turns, radius, of_radius):
    """Surface speed (m/s) of turns (1/min) at a radius."""
    if radius is None:
        raise SceneError(f"{where} = {shown(value)} needs the radius at which the surface turns, as in {value.strip()} at 40 "
                         "mm; allowed: a speed in m/s, or turns at a radius")
    r = in_unit(where, f"{radius} {of_radius}", "m")
    return 2 * math.pi * turns / 60 * r


def _scaled(digits, size):
    """Digits times a power of ten as one exactly rounded number: 3.8 mm is 0.0038."""
    power = round(math.log10(size)) if size > 0 else 0
    if size == float(f"1e{power}"):
        mantissa, _, exponent = digits.lower().partition("e")
        return float(f"{mantissa}e{int(exponent or 0) + power}")
    return float(digits) * size


def _clean(value):
    """A temperature without the rounding error of its offset."""
    return round(value, 9)


def _named(name, table):
    """Entry of a unit in a table, in any spelling; None if unknown."""
    return {_plain(known): entry for known, entry in table.items()}.get(_plain(name))


def _plain(name):
    return "".join(SPELLED.get(letter, letter) for letter in name)


def _refused(where, value, name, unit):
    known = list(TEMPERATURES if unit == "deg C" else UNITS.get(unit, {}))
    if unit == "m/s":
        known.append("rpm at a radius")
    allowed = f"a number in {unit}" if unit.strip("-") else "a number"
    units = f", or with one of the units {', '.join(known)}" if known else ""
    meant = checks.nearest(name, known)
    return SceneError(f"{where} = {shown(value)}: {shown(name)} is no unit of it{meant}; allowed: {allowed}{units}")
