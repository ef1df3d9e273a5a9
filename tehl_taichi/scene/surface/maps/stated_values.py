"""Unit and point distances that a file of heights states in its header or format."""

import math
import re
from dataclasses import dataclass
from typing import Any

from tehl_taichi.scene.surface.maps.length_units import MICRO, UNITS

NAMES = {"nanomet": "nm", "micromet": "um", "micron": "um", "millimet": "mm", "meter": "m", "metre": "m"}  # beginnings
NUMBER = re.compile(r"[-+]?\d+(?:[.,]\d+)?(?:e[-+]?\d+)?")
BRACKET = re.compile(r"[\[(]\s*([^\])]+?)\s*[\])]")
HEIGHT_UNIT = re.compile(r"(value|z|heights?|data|z data)?[ _-]*units?( z| of (the )?heights?)?$")
PLACE_UNIT = re.compile(r"(xy?|lateral|length)[ _-]*units?( xy?)?$")
STEP = "(pixel |point |sampling |sample |data )?(size|width|distance|spacing|step|increment|pitch|interval|calibration)"
STEPS = {axis: re.compile(f"({axis}|xy)[ _-]*{STEP}$|{STEP}[ _-]*({axis}|xy)$|d{axis}$|delta {axis}$") for axis in "xy"}
BOTH = re.compile("(pixel|point|sampling|sample|data)[ _-]*(size|width|distance|spacing|step|increment|pitch|interval)$")
EXTENT = "(length|range|extent|width)"
EXTENTS = {"x": re.compile(f"width$|(x|scan|field|profile|trace)[ _-]*{EXTENT}$|{EXTENT}[ _-]*x$"),
           "y": re.compile(f"height$|y[ _-]*{EXTENT}$|{EXTENT}[ _-]*y$")}
PLACES = {"x", "position", "distance", "length", "lateral"}  # names of columns
HEIGHTS = {"z", "height", "heights", "profile"}
ROUND = 2  # digits of a distance that a person has set


@dataclass(frozen=True)
class Stated:
    """Stated values. unit: of the heights, "" if unknown; x, y: possible distances of the points in a row and of the rows, m,
    the most likely first, () if unknown; place_unit: of coordinates, "" if unknown.
    """

    unit: str = ""
    x: tuple = ()
    y: tuple = ()
    place_unit: str = ""

    def with_spacing(self, spacing):
        """Stated values with the distances of coordinates, if their unit is known; spacing: in that unit, or None."""
        if not self.place_unit:
            return self
        x, y = (() if step is None else (step * UNITS[self.place_unit],) for step in spacing)
        return Stated(self.unit, x or self.x, y or self.y, self.place_unit)


def in_header(lines, shape):
    """Values that the header lines of a text file state; shape: (rows, columns) of its heights."""
    found: dict[str, Any] = {}
    sizes: dict[str, tuple[str, float]] = {}
    for key, values in filter(None, map(_parts, lines)):
        _note(found, sizes, key, values)
    for axis, count in zip("xy", shape[::-1]):
        if axis in sizes and axis not in found and count > 1:
            found[axis] = _steps(*sizes[axis], count)
    whole = found.pop("all", "")
    return Stated(found.get("z", whole), found.get("x", ()), found.get("y", ()), found.get("places", whole))


def column_names(lines):
    """First letters of the column names in the last header line, () without names."""
    words = re.split(r"[;,\t ]+", BRACKET.sub("", lines[-1].lstrip("#/ ")).strip()) if lines else ()
    return tuple(word.strip("\"'")[:1].lower() for word in words)


def unit_of(text):
    """Key of UNITS for the text of a unit, "" for other texts."""
    word = text.strip().strip("\"'[]().").replace("\ufffdm", "um").translate(MICRO)  # a micro sign of another encoding
    known = next((unit for name, unit in NAMES.items() if word.lower().startswith(name)), word)
    return known if known in UNITS else ""


def _parts(line):
    """(key, values) of a header line in lower case (units unchanged); None for a line without values."""
    text = line.lstrip("#/ ").strip()
    parts = [part.strip().strip("\"'").strip() for part in re.split(r"[;\t:=]", text) if part.strip()]
    if len(parts) == 1:
        parts = [part.strip().strip("\"'").strip() for part in text.split(",") if part.strip()]
    return (parts[0], parts[1:] or parts) if parts else None


def _note(found, sizes, key, values):
    """Store the value of a header line; the first one counts."""
    name, unit = BRACKET.sub("", key).strip().lower(), _unit_in(key, values)
    if not unit:
        return
    if HEIGHT_UNIT.match(name):
        found.setdefault("all" if name.startswith("unit") else "z", unit)
    elif PLACE_UNIT.match(name):
        found.setdefault("places", unit)
    elif (number := _number(values)) is None:
        _heads(found, [key, *values])
    else:
        _length(found, sizes, name, number, unit)


def _length(found, sizes, name, number, unit):
    for axis in "xy":
        if STEPS[axis].match(name) or BOTH.match(name):
            found.setdefault(axis, (float(number.replace(",", ".")) * UNITS[unit],))
        elif EXTENTS[axis].match(name):
            sizes.setdefault(axis, (number, UNITS[unit]))


def _heads(found, words):
    """Store units in the names of columns, such as x [mm], z [um]."""
    for word in words:
        unit, name = _unit_in(word, ()), BRACKET.sub("", word).strip().lower()
        if unit and name in PLACES:
            found.setdefault("places", unit)
        elif unit and name in HEIGHTS:
            found.setdefault("z", unit)


def _unit_in(key, values):
    """Unit in the brackets of a key, after a number, or alone among the values; "" without one."""
    inside = BRACKET.search(key)
    words = [inside[1]] if inside else [NUMBER.sub("", value.translate(MICRO), count=1) for value in values]
    return next(filter(None, map(unit_of, words)), "")


def _number(values):
    return next((match[0] for value in values if (match := NUMBER.match(value))), None)


def _steps(number, unit, count):
    """Possible distances (m) of `count` points on a length: one interval per point, or one fewer; the rounder value first."""
    length = float(number.replace(",", "."))
    each, between = length / count, length / (count - 1)
    spread = 10.0 ** -len(re.sub(r"e.*|\D", "", number.lower()).lstrip("0") or "0")
    return tuple(step * unit for step in sorted((each, between), key=lambda step: _digits(step, spread)))


def _digits(value, spread):
    """Number of digits of a value, given its relative error `spread`; ROUND + 1 if it has more."""
    return next((n for n in range(1, ROUND + 1) if math.isclose(float(f"{value:.{n - 1}e}"), value, rel_tol=spread)), ROUND + 1)
