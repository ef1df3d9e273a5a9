"""Strength tables of users: CSV files with names and units in the first line."""

import os
from pathlib import Path

from tehl_taichi.disk import files
from tehl_taichi.errors import SceneError
from tehl_taichi.scene.strength import table
from tehl_taichi.scene.strength.profiles import PROFILES
from tehl_taichi.scene.strength.table import DEPTH, HARDNESS, KAPPA, LIMIT, RESIDUAL, YIELD
from tehl_taichi.values.checks import near_file, nearest
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.quantity import Number
from tehl_taichi.values.text_table import rows_of, taken_elsewhere, without_empty_end, wrong_length

MOST, LARGEST = 500, 1e6  # rows, bytes
STRESS = {"Pa": 1.0, "MPa": 1e6}
# {quantity of a column: (its name in SI units, {unit: factor}, declaration in SI units)}
KNOWN = {"depth": (DEPTH, {"m": 1.0, "mm": 1e-3, "um": 1e-6}, Number("", "m", 0.0, 0.03, usual=5e-4)),
         "hardness": (HARDNESS, {"HV": 1.0}, Number("", "HV", 50.0, 1200.0, usual=600.0)),
         "limit": (LIMIT, STRESS, Number("", "Pa", 1e6, 1e11, usual=4e8)),
         "kappa": (KAPPA, {"": 1.0}, Number("", "", 0.0, 5.0, usual=0.3)),
         "yield_stress": (YIELD, STRESS, Number("", "Pa", 1e6, 1e11, usual=2e9)),
         **{name[:-3]: (name, STRESS, Number("", "Pa", -1e10, 1e10, usual=-2e8, least=1e5)) for name in RESIDUAL}}
NAMES = {"_".join(filter(None, (what, unit))): (what, unit) for what, (_, units, _) in KNOWN.items() for unit in units}
NEEDED = "depth_mm (or _um, _m) and either hardness_HV or limit_MPa (or _Pa)"


def text_of(place, key):
    """Text (see :mod:`tehl_taichi.scene.strength.table`) of a built-in profile or a file; key: of the scene, for messages.
    Raises SceneError.
    """
    if place in PROFILES:
        return PROFILES[place]
    where = f"{key} = {shown(place)}"
    return table.text_of(_columns(where, _rows(where, _read(where, Path(place), place))))


def check(found):
    """Refuse invalid numbers of a StrengthTable. Raises SceneError."""
    declared = {key: kind for key, _, kind in KNOWN.values()}
    for key, values in found.columns.items():
        for value in values:
            declared[key].check(f"fatigue.table_rows: {key}", value)
    _check_depths("fatigue.table_rows", found.columns[DEPTH])
    if found.has(HARDNESS) == found.has(LIMIT):
        raise SceneError(f"fatigue.table_rows needs {HARDNESS} or {LIMIT}, not both of these")


def _read(where, path, place):
    """Text of the file. Raises SceneError."""
    if not os.path.isfile(path):
        meant = nearest(place, PROFILES) or near_file(place)
        raise SceneError(f"{where} is neither a file nor a built-in profile{meant}; built in: {', '.join(PROFILES)}")
    try:
        return files.content(path, LARGEST).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise SceneError(f"{where} is not a text file; allowed: CSV with the columns {NEEDED}") from None
    except OSError as error:
        raise SceneError(f"{where} cannot be read: {getattr(error, 'strerror', None) or error}") from None


def _rows(where, content):
    """Rows of the file as lists of words. Raises SceneError."""
    try:
        rows = [row for _, row in rows_of(content)]
    except ValueError as error:
        raise SceneError(f"{where} cannot be read: {error}") from None
    if not 2 <= len(rows) <= MOST + 1:
        raise SceneError(f"{where} has {max(len(rows) - 1, 0)} rows of numbers; allowed: 1 to {MOST} below a line of names")
    return rows


def _columns(where, rows):
    """{name in SI units: numbers} of rows of words with the names first. Raises SceneError."""
    names, *lines = rows
    names = without_empty_end(names)
    _check_names(where, names)
    _check_lengths(where, len(names), lines)
    out = {}
    for n, name in enumerate(names):
        what, unit = NAMES[name]
        key, units, declared = KNOWN[what]
        out[key] = [declared.read(f"{where}, row {at}: {what}", row[n], units[unit]) for at, row in enumerate(lines, 1)]
    _check_depths(where, out[DEPTH])
    return {DEPTH: out.pop(DEPTH), **out}


def _check_names(where, names):
    for name in names:
        if name not in NAMES:
            meant = nearest(name, NAMES) if NAMES.keys() & set(names) else ""  # no name is known: a table for other things
            raise SceneError(f"{where} has a column {shown(name)}{meant}; known: {', '.join(NAMES)}"
                             f"{taken_elsewhere(names, '`tehl run --table`')}")
    known = [NAMES[name][0] for name in names]
    if twice := sorted({what for what in known if known.count(what) > 1}):
        raise SceneError(f"{where} has two columns of {twice[0]}; remove one of them")
    if "depth" not in known or ("hardness" in known) == ("limit" in known):
        raise SceneError(f"{where} has the columns {', '.join(names)}; needed: {NEEDED}, not both of these")


def _check_lengths(where, count, lines):
    for at, row in enumerate(lines, 1):
        if refusal := wrong_length(row, count):
            raise SceneError(f"{where}, row {at} {refusal}")


def _check_depths(where, depths):
    for at, (above, below) in enumerate(zip(depths, depths[1:]), 2):
        if not below > above:
            raise SceneError(f"{where}, row {at}: the depth {below * 1e6:g} um does not exceed the one before, {above * 1e6:g} "
                             "um; allowed: rising depths")
