"""Rows of a user's CSV table, with units in column names."""

import re

from tehl_taichi.disk import files
from tehl_taichi.errors import SceneError
from tehl_taichi.values import units
from tehl_taichi.values.checks import near_file
from tehl_taichi.values.text_table import meant_column, rows_of, taken_elsewhere, without_empty_end, wrong_length

WITH_UNIT = re.compile(r"(\w+)\s*[/\[(]\s*(.+?)[\])]?\s*")  # load/N, load (N), load [N]
SPEEDS = "u_a", "u_b"  # whose names have m_s in place of m_per_s
# {usual name of a column: (its quantity, unit that the parser of units knows, factor to the unit of the usual name)}
COLUMNS = {"angle_deg": ("angle", "deg", 1.0), "load_N_per_mm": ("load", "N/m", 1e-3), "u_a_m_s": ("u_a", "m/s", 1.0),
           "u_b_m_s": ("u_b", "m/s", 1.0), "R_mm": ("R", "mm", 1.0), "R_a_mm": ("R_a", "mm", 1.0), "R_b_mm": ("R_b", "mm", 1.0),
           "x_pl_mm": ("x_pl", "mm", 1.0), "bulk_C": ("bulk", "deg C", 1.0)}


def rows(path):
    """(column names, [{name: text}]) of a file; columns in other units are converted to the usual names and units. Raises
    SceneError.
    """
    try:
        heads, *lines = [row for _, row in rows_of(files.text(path))] or [[]]
    except (OSError, ValueError) as error:
        raise SceneError(f"cannot read table {path}: {getattr(error, 'strerror', None) or error}{near_file(path)}") from None
    columns = [_column(head) for head in without_empty_end(heads)]
    names = [name for name, _ in columns]
    if number := next(filter(units.BARE.fullmatch, names), ""):
        raise SceneError(f"table {path} begins with the number {number}; allowed: a line of names, without # before it")
    if twice := sorted({name for name in names if name and names.count(name) > 1}):
        raise SceneError(f"table {path} has the column {twice[0]} twice; remove one of them")
    _check_lengths(path, len(names), lines)
    return names, [{name: _value(name, unit, text) for (name, unit), text in zip(columns, line)} for line in lines]


def check_names(path, names, needed, words, taker):
    """Refuse a table without one of the needed columns. Raises SceneError.

    words: text of the needed columns; taker: see :func:`tehl_taichi.values.text_table.taken_elsewhere`.
    """
    if missing := [name for name in needed if name not in names]:
        others = [name for name in names if name not in COLUMNS]
        named = ", ".join(f"{name}{meant_column(COLUMNS[name][0], others)}" for name in missing)
        raise SceneError(f"table {path} has no column {named}; needed: {words}{taken_elsewhere(names, taker)}")


def _check_lengths(path, count, lines):
    for at, line in enumerate(lines, 2):
        if refusal := wrong_length(line, count):
            raise SceneError(f"table {path}, row {at} {refusal}")


def _column(head):
    """(usual name, user's unit) of a column; unit "" for a usual or an unknown name."""
    if head in COLUMNS:
        return head, ""
    for name, (quantity, unit, _) in COLUMNS.items():
        for own in _units(head, quantity):
            if units.known(own, unit):
                return name, own
    return head, ""


def _units(head, quantity):
    """Possible units in a column head, such as N/mm of load_N_per_mm or of load (N/mm), if it is one of the quantity."""
    if (match := WITH_UNIT.fullmatch(head)) and match[1] == quantity:
        return [match[2]]
    if not head.startswith(f"{quantity}_"):
        return []
    rest = head.removeprefix(f"{quantity}_").replace("_per_", "/")
    return [rest.replace("_", "/")] if quantity in SPEEDS else [rest]


def _value(name, unit, text):
    """Text of a value in the usual unit."""
    if not unit or units.split(text) is None:
        return text
    _, known, factor = COLUMNS[name]
    return repr(units.in_unit(name, f"{text} {unit}", known) * factor)
