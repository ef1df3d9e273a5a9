"""Columns of tables of places (positions, angles, rings): for the screen, the page and the CSV file."""

import csv
import io
from dataclasses import dataclass
from typing import Callable

from tehl_taichi.values.digits import with_bar, with_error
from tehl_taichi.values.escape import cell


@dataclass(frozen=True)
class TableColumn:
    """name: with its SI unit, for the CSV file; head, factor, form: of the printed table `table`; value, error: functions of
    what describes a place, give None where missing.
    """

    name: str
    head: str
    factor: float
    form: str
    value: Callable
    table: str
    error: Callable = lambda *place: None

    @property
    def barred(self):
        """Whether its values have error bars (which may be unknown)."""
        return self.error is not TableColumn.error

    def shown(self, *place):
        value, error = self.value(*place), self.error(*place)
        if value is None or isinstance(value, str):
            return value or ""
        value *= self.factor
        text = format(value, self.form) if error is None else with_error(value, error * self.factor)
        return with_bar(text, error) if self.barred else text


def csv_lines(columns, places):
    """Head and a line per place, in SI units: values, followed by the error bars of the columns that have some."""
    with_bars = [column for column in columns if any(column.error(*place) is not None for place in places)]
    return [[*(column.name for column in columns), *(f"error_{column.name}" for column in with_bars)],
            *([*(column.value(*place) for column in columns), *(column.error(*place) for column in with_bars)]
              for place in places)]


def csv_text(lines):
    """CSV text of lines of values."""
    text = io.StringIO()
    csv.writer(text).writerows(map(cell, line) for line in lines)
    return text.getvalue()
