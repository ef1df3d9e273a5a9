"""Heights in text files of instruments: header, marks of unmeasured points, separators of columns."""

import re
from dataclasses import dataclass, replace

import numpy as np

from tehl_taichi.scene.surface.maps import coordinates, line_profiles, point_lists, stated_values
from tehl_taichi.scene.surface.maps.stated_values import Stated
from tehl_taichi.values import text_table
from tehl_taichi.values.digits import number_of

COLUMNS = (*text_table.MARKS, None)  # what may stand between two heights, the first that a row has; None: blanks
UNMEASURED = ("bad", "bad data", "nan", "na", "n/a", "no data", "no_data", "nodata", "null")  # also nothing, and * or - alone
MARKS = "bad, nan, no data, ***, --- or an empty field"
SPLIT = {"no data": "nodata", "bad data": "bad"}  # marks of two words, which blanks would part
SECTION = "[profile_values]"  # below it every line has the number of its point and an = before the values
NUMBER = re.compile(r"^\s*\d+\s*=")


@dataclass(frozen=True)
class Table:
    """values: heights (rows, columns) in the unit of the file, nan if not measured; stated: its unit and distances;
    header_lines: lines before the first row; inside: number of comment lines (#) after it (none for binary files); falling:
    whether its coordinates fall (along a row, from row to row).
    """

    values: np.ndarray
    stated: Stated = Stated()
    header_lines: tuple = ()
    inside: int = 0
    beside: tuple = ()
    spacing: tuple = (None, None)
    falling: tuple = (False, False)

    def without_coordinates(self):
        """Table of the heights alone, of a line profile in one row; see :meth:`_grid`."""
        found = line_profiles.heights_of(self.values)
        if found is None:
            return self._grid()
        heights, step, beside = found
        return replace(self, values=heights, beside=beside, spacing=(step, None))._with_stated()

    def of_points(self):
        """Grid of a list of points; None if they lie on no grid."""
        found = point_lists.grid_of(self.values, stated_values.column_names(self.header_lines))
        if found is None:
            return None
        heights, x, y = found
        return replace(self, values=heights, beside=("x and y of a list of points",), spacing=(x, y))._with_stated()

    def _grid(self):
        """Table of the heights alone; beside: description of the removed coordinates; spacing: their distances (along a row,
        from row to row), None without any.
        """
        found = coordinates.separate(self.values)
        return replace(self, values=found.heights, beside=found.found_lines, spacing=(found.x, found.y))._with_stated()

    def _with_stated(self):
        """Table with the values that its header states, and with positive distances."""
        stated = stated_values.in_header(self.header_lines, self.values.shape) if self.header_lines else self.stated
        falling, spacing = zip(*((bool(step and step < 0), step and abs(step)) for step in self.spacing))
        return replace(self, stated=stated.with_spacing(spacing), spacing=spacing, falling=falling)

    @property
    def skipped(self):
        """Description of skipped parts; "" without any."""
        counts = ((len(self.header_lines), "header line", "skipped"), (self.inside, "line", "with # among the heights skipped"))
        lines = [f"{number_of(count, what)} {why}" for count, what, why in counts if count]
        return ", ".join([*lines, *(f"{what} skipped" for what in self.beside)])


def read(path):
    """Read the :class:`Table` of a text file. Raises ValueError with the line: a word among the heights, a row of another
    length than the first, no row at all.
    """
    with path.open(encoding=_encoding(path), errors="replace") as file:  # headers have other encodings of a micro sign
        lines = [(number, line.rstrip("\r\n ")) for number, line in enumerate(file, 1) if line.strip(" \r\n")]
    numbered = _section([(number, line.split("#")[0]) for number, line in lines if not line.startswith("#")])
    header, mark = _first_row(numbered)
    _check_header(numbered[:header], numbered[header], mark)
    rows, ended = _rows(numbered[header:], mark)
    first = numbered[header][0]
    before, after = ([line for number, line in lines if (number < first) == early and number != first] for early in (1, 0))
    values = np.array(rows)
    return Table(values[:, :-1] if ended else values, header_lines=tuple(before), inside=sum(line[0] == "#" for line in after))


def _encoding(path):
    """Encoding by the first bytes: UTF-16 has a mark, or zero in every second byte."""
    with path.open("rb") as file:
        first = file.read(4)
    if first[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "utf-16"
    return "utf-16-le" if first[1::2] == b"\0\0" else "utf-16-be" if first[::2] == b"\0\0" else "utf-8-sig"


def _section(lines):
    """Lines of a file; if it has a section of profile values, those lines without their numbers, and the header before."""
    begins = next((index for index, (_, line) in enumerate(lines) if line.strip().lower() == SECTION), None)
    if begins is None:
        return lines
    values = [(number, NUMBER.sub("", line)) for number, line in lines[begins + 1:] if NUMBER.match(line)]
    return lines[:begins + 1] + values


def _first_row(lines):
    """(index of the first line that is a row of heights, separator of its columns)."""
    for index, (_, line) in enumerate(lines):
        for mark in (mark for mark in COLUMNS if mark is None or mark in line):
            words = _words(line, mark)
            if words and all(map(_is_height, words)) and (len(words) > 1 or not _unmeasured(words[0])):
                return index, _between(lines[index:], mark)
    raise ValueError("no line is a row of numbers")


def _between(lines, mark):
    """Separator of columns, but None if it is the decimal comma of a single column: whole numbers before and after it that do
    not rise.
    """
    if mark != ",":
        return mark
    pairs = [line.split(",") for _, line in lines]
    if any(len(pair) != 2 or not all(word.strip().lstrip("-+").isdigit() for word in pair) for pair in pairs):
        return mark
    first = [float(whole) for whole, _ in pairs]
    return mark if all(a < b for a, b in zip(first, first[1:])) else None


def _check_header(header, first, mark):
    """Raise ValueError for a header line that looks like a row with a wrong word: as many columns as the first row, mostly
    numbers.
    """
    columns = len(_words(first[1], mark))
    for number, line in header:
        words = _words(line, mark)
        if len(words) == columns and 2 * sum(map(_is_height, words)) > columns:
            _row(number, words)


def _rows(lines, mark):
    """(rows of heights, whether a separator ends every row)."""
    rows, ended = [], mark is not None
    for number, line in lines:
        rows.append(_row(number, _words(line, mark)))
        ended = ended and line.endswith(mark)
        if len(rows[-1]) != len(rows[0]):
            raise ValueError(f"line {number} has {len(rows[-1])} columns, the first row (line {lines[0][0]}) {len(rows[0])}")
    return rows, ended


def _words(line, mark):
    """Columns of a line; if the separator is no comma, numbers may have decimal commas."""
    line = line if mark == "," else line.replace(",", ".")
    words = line.split(mark) if mark else _joined(line).split()
    return ["nan", *words[1:]] if _has_corner(words) else words


def _has_corner(words):
    """Whether a line holds coordinates after the name of its corner, such as 'y/x, 0, 1, 2, ...'."""
    if len(words) < 5 or _is_height(words[0]):
        return False
    try:
        return coordinates.is_even(np.array(words[1:], float))
    except ValueError:
        return False


def _joined(line):
    """The line, with marks of two words joined to one."""
    low = line.lower()
    for two, one in SPLIT.items():
        low = low.replace(two, one)
    return low


def _row(number, words):
    """Heights in the columns of line `number`. Raises ValueError."""
    try:
        return np.array(words, dtype=float)
    except ValueError:
        return np.array([_height(number, word) for word in words])


def _height(number, word):
    if _unmeasured(word):
        return np.nan
    if not _is_height(word):
        raise ValueError(f"line {number}: {word.strip()[:40]!r} is neither a number nor a mark of an unmeasured point "
                         f"({MARKS})")
    return float(word)


def _unmeasured(word):
    return word.strip().lower().strip("*-") in ("", *UNMEASURED)


def _is_height(word):
    try:
        float(word)
    except ValueError:
        return _unmeasured(word)
    return True
