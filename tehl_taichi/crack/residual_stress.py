"""Residual stress along the surface: a number, or rows of depth and stress, linear between them and constant beyond."""

import os
import re
from pathlib import Path

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.values import units
from tehl_taichi.values.coerce import plain, shown
from tehl_taichi.values.digits import is_number
from tehl_taichi.values.quantity import Number
from tehl_taichi.values.text_table import rows_of, without_empty_end, wrong_length

LARGEST = 5e9  # Pa
STRESS = Number("", "Pa", -LARGEST, LARGEST, usual=-2e8, least=1e5)
DEPTH = Number("", "m", 0.0, 0.03, usual=1e-4)
WANTED = "lines with depth in m and stress in Pa; a header line may name the columns, and other units (depth_um, stress_MPa)"
COMMENT = re.compile(r"#.*")
IN = re.compile(r"\s+in\s+", re.IGNORECASE)  # depth in m; the inch is last
BETWEEN = re.compile(r"[\s_()\[\]/,.;:*^-]+")  # words in the name of a column
STATED = re.compile(r"[/(\[]\s*\(?([^()\[\]]+?)\s*[)\]]*$")  # the end in brackets or after a slash, as N/mm2
MICRO = str.maketrans({"\u00b5": "u", "\u03bc": "u"})
PREFIXES = ("nano", "micro", "milli", "centi", "kilo", "mega", "giga", "inch")  # of units that are written in full
SAME = {"m": ("m", "metre", "metres", "meter", "meters"), "Pa": ("pa", "pascal")}
# {unit of a quantity: words for units that are not known, or not in these letters}
OTHERS = {"m": {"dm", "km", "mil", "mils", "thou", "ft", *map(str.lower, units.LENGTH)} - {"m"},
          "Pa": {"hpa", "ksi", "msi", "tsi", "atm", "n", "kn", "kp", "kgf", "lbf", *map(str.lower, units.PRESSURE)} - {"pa"}}


class ResidualStress:
    """Residual stress (Pa) as a function of depth (m).

    given: Pa, or rows (depth m, Pa) with increasing depths from 0 or more. Raises SceneError for anything else, and for numbers
    that make sense in another unit only.
    """

    def __init__(self, given):
        given = units.in_unit("residual", plain(given), "Pa")
        if isinstance(given, (int, float)):
            STRESS.check("residual", given)
            given = [(0.0, given)]
        try:
            table = np.array(given, float)
        except (TypeError, ValueError):
            table = np.zeros(0)
        if table.ndim != 2 or table.shape[1] != 2 or not np.isfinite(table).all():
            raise SceneError(f"residual = {shown(given)} must be a stress in Pa, or rows of two numbers: depth in m, stress in "
                             "Pa")
        self.depth, self.stress = table.T
        if self.depth[0] < 0 or (np.diff(self.depth) <= 0).any():
            raise SceneError("the depths of the residual stress must increase, from 0 m or more")
        DEPTH.check("the deepest residual stress", float(self.depth[-1]))
        STRESS.check("the largest residual stress", float(self.stress[np.argmax(np.abs(self.stress))]))

    def __call__(self, depth):
        return np.interp(depth, self.depth, self.stress)


def read(text):
    """Read the value of `--residual`: a number in Pa, text of one with a unit, or the name of a CSV file. Raises SceneError."""
    path = Path(text)
    if not os.path.isfile(path):
        if number := units.split(text):
            return text if number[1] else float(text)
        raise SceneError(f"--residual {text!r} is neither a stress in Pa nor a file")
    try:
        return _rows(rows_of(COMMENT.sub("", path.read_text(encoding="utf-8-sig"))))
    except (ValueError, OSError) as error:
        raise SceneError(f"--residual {text}: {error}; allowed: {WANTED}") from None


def _rows(lines):
    """Array of rows (depth, stress) of lines [(number, cells)]; a header line may name the columns. Raises ValueError."""
    if not lines:
        raise ValueError("it is empty")
    columns, count, why, head = ((0, 1.0), (1, 1.0)), 2, "depth and stress", without_empty_end(lines[0][1])
    if not all(map(is_number, head)):
        columns, count, why, lines = _named(head), len(head), "as in the line of names", lines[1:]
    if not lines:
        raise ValueError("it has no numbers below its line of names")
    for n, words in lines:
        if refusal := wrong_length(words, count, why):
            raise ValueError(f"line {n} {refusal}")
    return np.array([[_number(n, words[column]) * size for column, size in columns] for n, words in lines], float)


def _named(head):
    """[(number of the column, size of its unit in SI)] of depth and stress, by the names of the columns. Raises ValueError."""
    found = [[n for n, word in enumerate(head) if any(part in word.lower() for part in parts)]
             for parts in (("depth",), ("stress", "sigma", "residual"))]
    if [len(columns) for columns in found] != [1, 1]:
        raise ValueError(f"its first line, {', '.join(head)[:80]!r}, names no depth and stress")
    return [(column, _size(head[column], unit)) for (column,), unit in zip(found, OTHERS)]


def _size(name, unit):
    """Size of the unit in the name of a column, 1 without one. Raises ValueError for a unit that is not known."""
    stated = [match[1] for match in STATED.finditer(IN.sub("/", name))]
    words = [word for word in BETWEEN.split(IN.sub(" ", name)) if word]
    if own := next((word for word in (*stated, *words) if units.known(word, unit)), ""):
        return units.in_unit(name, f"1 {own}", unit)
    others = [word for word in words if _is_other(word.translate(MICRO).lower(), unit)]
    if others := [*others, *(word for word in stated if word.lower() not in SAME[unit])]:
        raise ValueError(f"its column {name!r} is in {others[0]}, which is not one of {', '.join(units.UNITS[unit])}")
    return 1.0


def _is_other(word, unit):
    return word in OTHERS[unit] or word.startswith(PREFIXES)


def _number(n, word):
    if not is_number(word):
        raise ValueError(f"line {n}: {shown(word)} is not a number")
    return float(word)
