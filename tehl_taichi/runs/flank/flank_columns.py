"""Table columns of a flank: for the table on the screen, the CSV file and the figure."""

import csv
import io
from dataclasses import dataclass
from typing import Callable

from tehl_taichi.fatigue.judged_layers import worst_layer
from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.fatigue.pressure_alone import why_none
from tehl_taichi.march import quantities
from tehl_taichi.scene import surface_roughness
from tehl_taichi.values.digits import with_error
from tehl_taichi.values.escape import cell


@dataclass(frozen=True)
class TableColumn:
    """name: with its SI unit, for the CSV file; head, factor, form: of the printed table `table`; value, error: functions of
    (position, p_H, summary), give None where missing.
    """

    name: str
    head: str
    factor: float
    form: str
    value: Callable
    table: str

    @property
    def barred(self):
        """Whether its values have error bars (which may be unknown)."""
        return isinstance(self.value, (_SummaryValue, _DecidingIndex))

    def error(self, *row):
        return self.value.error(*row) if isinstance(self.value, (_SummaryValue, _DecidingIndex)) else None

    def shown(self, *row):
        value, error = self.value(*row), self.error(*row)
        if value is None or isinstance(value, str):
            return value or ""
        value *= self.factor
        return format(value, self.form) if error is None else with_error(value, error * self.factor)


def value_at(summary, *keys):
    """Value in a summary by its nested keys; None if it is missing or if there is no summary."""
    for key in keys:
        summary = (summary or {}).get(key)
    return summary


def error_of(summary, *keys):
    """Error bar of a value in a summary by its nested keys; None if it is missing."""
    return value_at(summary, *keys[:-1], "error", keys[-1])


def shown_value(summary, *keys):
    """Value for tables and figures by its keys; None for the distribution over a single feature, where the largest index says
    more.
    """
    if "statistics" in keys and not value_at(summary, "fatigue", "rough"):
        return None
    return value_at(summary, *keys)


def plotted_value(at, p_H, summary, what):
    """(value, error bar) of a series of a figure, None where missing; what: keys in the summary, or the name of a number of the
    position.
    """
    if isinstance(what, tuple):
        return shown_value(summary, *what), error_of(summary, *what)
    if what == "judged":
        return judged_index(summary)
    return {"p_H": p_H, "srr": at.srr if p_H else None, **at.film_ratios}.get(what), None


def judged_index(summary):
    """(Fi, its error bar) that decides about a position, for rough surfaces a percentile; (None, None) without an index."""
    found = value_at(summary, "fatigue")
    if not found or why_none(found):
        return None, None
    _, Fi, error = worst_layer(by_surface(summary))
    return Fi, error


class _DecidingIndex:
    """Column of the index that decides about a position, with its error bar."""

    def __call__(self, position, p_H, summary):
        return judged_index(summary)[0]

    def error(self, position, p_H, summary):
        return judged_index(summary)[1]


class _SummaryValue:
    """Column of a number of the summary, with its error bar."""

    def __init__(self, *keys):
        self.keys = keys

    def __call__(self, position, p_H, summary):
        return shown_value(summary, *self.keys)

    def error(self, position, p_H, summary):
        return error_of(summary, *self.keys)


class _PassageValue(_SummaryValue):
    """Column of a number of a passage; empty for steady contacts."""

    def __call__(self, position, p_H, summary):
        return super().__call__(position, p_H, summary) if value_at(summary, "transient") else None


CONTACT, STEADY, PASSAGE = TABLES = ("contact", "steady film", "while the feature passes")
# of the parts of a summary
TITLES = {"steady": STEADY, **dict.fromkeys(("transient", "fatigue", "fatigue.statistics", "fatigue.below",
                                             "fatigue.below.statistics"), PASSAGE)}
COLUMNS = (
    TableColumn("point", "at", 1, "", lambda at, *_: at.point, CONTACT),
    TableColumn("x_pl_m", "x_pl mm", 1e3, ".3f", lambda at, *_: at.x_pl, CONTACT),
    TableColumn("arc_m", "arc mm", 1e3, ".3f", lambda at, *_: at.arc, CONTACT),
    TableColumn("R_m", "R' mm", 1e3, ".3f", lambda at, *_: at.R, CONTACT),
    TableColumn("u_m_m_s", "u_m m/s", 1, ".3f", lambda at, *_: at.u_m, CONTACT),
    TableColumn("srr", "SRR", 1, ".3f", lambda at, *_: at.srr, CONTACT),
    TableColumn("load_N_m", "N/mm", 1e-3, ".1f", lambda at, *_: at.load, CONTACT),
    TableColumn("bulk_C", "bulk deg C", 1, ".1f", lambda at, *_: at.bulk, CONTACT),
    TableColumn("p_Hertz_Pa", "p_H GPa", 1e-9, ".3f", lambda at, p_H, _: p_H, CONTACT),
    *(TableColumn(one.column, one.head, one.factor, one.form, _SummaryValue(*one.part.split("."), one.key), TITLES[one.part])
      for one in quantities.ENTRIES if one.column),
    TableColumn("Sq_m", "Sq um", 1e6, ".3f",
                lambda at, p_H, found: surface_roughness.rms_of(value_at(found, "roughness")), STEADY),
    TableColumn("lambda", "lambda", 1, ".2f", _SummaryValue("lambda"), STEADY),
    TableColumn("lambda_GF", "lambda_GF", 1, ".3f", lambda at, *_: at.film_ratios.get("lambda_GF"), STEADY),
    TableColumn("h_min_Ra", "h_min/Ra", 1, ".3f", lambda at, *_: at.film_ratios.get("h_min_Ra"), STEADY),
    TableColumn("Fi_judged", "Fi judged", 1, ".3f", _DecidingIndex(), PASSAGE),
    TableColumn("von_mises_max_Pa", "Mises GPa", 1e-9, ".3f", _PassageValue("von_mises", "max_Pa"), PASSAGE),
    TableColumn("passages", "passages", 1, ".2g", _SummaryValue("life", "passages"), PASSAGE),
    TableColumn("hours", "hours", 1, ".2g", _SummaryValue("life", "hours"), PASSAGE),
    TableColumn("worse_body", "body", 1, "", lambda at, p_H, summary: value_at(summary, "fatigue", "surface"), PASSAGE),
)


def used_columns(rows, columns=COLUMNS):
    """Columns with a value in any of the rows (position, p_H, summary)."""
    return [column for column in columns if any(column.value(*row) not in (None, "") for row in rows)]


def tables(rows, of=COLUMNS, places=2):
    """{title: (heads, lines)} of the tables with values; the first `places` columns, the positions, are in each."""
    columns, out = used_columns(rows, of), {}
    for title in TABLES:
        found = [column for column in columns if column.table == title]
        if title != CONTACT and found:
            found = [column for column in of[:places] if column in columns] + found
        if found:
            heads, lines = [column.head for column in found], [[column.shown(*row) for column in found] for row in rows]
            out[title_of(title, [row[-1] for row in rows])] = heads, lines
    return out


def title_of(part, summaries):
    """Title of a part of the results; stresses of steady contacts are titled "stress", since only the load causes them."""
    passes = any(value_at(summary, key) for summary in summaries for key in ("transient", "fatigue"))
    return "stress" if part == PASSAGE and not passes else part


def csv_text(rows, of=COLUMNS):
    """Table as CSV in SI units, followed by the error bars and the further columns of the user's table of positions."""
    columns, more = used_columns(rows, of), list(dict.fromkeys(key for at, *_ in rows for key in at.more))
    with_bars = [column for column in columns if any(column.error(*row) is not None for row in rows)]
    text = io.StringIO()
    out = csv.writer(text)
    out.writerow(map(cell, [*(column.name for column in columns), *(f"error_{column.name}" for column in with_bars), *more]))
    out.writerows(map(cell, [*(column.value(*row) for column in columns), *(column.error(*row) for column in with_bars),
                             *(row[0].more.get(key) for key in more)]) for row in rows)
    return text.getvalue()
