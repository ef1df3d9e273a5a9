"""Tables in text files of users: separator of the columns, cells, and rows that a wrong separator has cut."""

import csv
import difflib
import re

from tehl_taichi.values.digits import number_of

MARKS = ";", "\t", ","  # the first that a text has: with the others numbers may have decimal commas
# {column that only one kind of table has: command or option that takes such a table}
TAKEN_BY = {"x_pl_mm": "`tehl flank`", "angle_deg": "`tehl cam`",
            **dict.fromkeys(("depth_mm", "depth_um", "depth_m"), "`tehl run --table`")}
ALIKE = 0.7  # of the letters of a quantity, in the head of a column that was perhaps meant: angel and angle
COMMA = re.compile(r"([-+]?\d*),(\d+(?:[eE][-+]?\d+)?)")  # a decimal one


def rows_of(text):
    """[(line number, cells)] of a table, without empty rows and comments (lines that begin with #). Raises ValueError.

    The first row shows the separator, blanks if it has no other one; numbers have decimal points.

    >>> rows_of("# in mm\\n\\ndepth;note\\n0,5;1,2,3\\n")
    [(3, ['depth', 'note']), (4, ['0.5', '1,2,3'])]
    """
    lines = [(n, line) for n, line in enumerate(text.splitlines(keepends=True), 1) if line.strip() and line.lstrip()[0] != "#"]
    mark = _column_mark(lines[0][1]) if lines else None
    cells = _split([line for _, line in lines], mark) if mark else ((at, line.split()) for at, (_, line) in enumerate(lines))
    try:
        rows = [(lines[at][0], [_cell(one.strip(), mark) for one in row]) for at, row in cells]
    except csv.Error as error:
        raise ValueError(str(error)) from None
    return [(n, row) for n, row in rows if any(row)]


def _column_mark(line):
    return next((mark for mark in MARKS if mark in line), None)


def _split(lines, mark):
    """Generator of (number of its last line, cells) of each row."""
    reader = csv.reader(lines, delimiter=mark, skipinitialspace=True)
    yield from ((reader.line_num - 1, row) for row in reader)


def _cell(text, mark):
    match = COMMA.fullmatch(text) if mark != "," else None
    return f"{match[1]}.{match[2]}" if match else text


def without_empty_end(names):
    """Names of columns without empty ones at the end: spreadsheets end lines with separators."""
    last = max((n for n, name in enumerate(names, 1) if name), default=0)
    return names[:last]


def wrong_length(row, count, why="as in the line of names"):
    """End of a sentence about a row with more or fewer cells than `count`; "" for a row that fits.

    Empty cells beyond the names count as none, as in :func:`without_empty_end`.
    """
    if len(row) >= count and not any(row[count:]):
        return ""
    return (f"has {number_of(len(row), 'column')}; allowed: {count}, {why} (a decimal comma needs a semicolon between "
            "columns)")


def meant_column(quantity, heads):
    """Text ' (did you mean ...?)' with the head that begins most like the name of a quantity, or nothing.

    >>> meant_column("x_pl", ["R_mm", "xpl [mm]"]), meant_column("x_pl", ["R_mm"])
    (" (did you mean 'xpl [mm]'?)", '')
    """
    found = [(_likeness(quantity, head), head) for head in heads]
    most, head = max(found, default=(0.0, ""), key=lambda one: one[0])
    return f" (did you mean {head!r}?)" if most >= ALIKE else ""


def _likeness(quantity, head):
    own, other = (re.sub("[^a-z0-9]", "", text.lower()) for text in (quantity, head))
    return difflib.SequenceMatcher(None, own, other[:len(own)]).ratio()


def taken_elsewhere(names, taker):
    """Text that names who takes a table with these columns; "" if `taker` does, or for unknown ones."""
    found = {TAKEN_BY[name]: name for name in names if name in TAKEN_BY}
    if not found or taker in found:
        return ""
    other, name = next(iter(found.items()))
    return f"; a table with {name} is one for {other}"
