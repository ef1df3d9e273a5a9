"""What is told of a position, a column each: for the table on the screen, the CSV file and the figure."""

import csv
import io
from dataclasses import dataclass
from typing import Callable


@dataclass(frozen=True)
class Column:
    """name: with its SI unit, of the CSV file; head, factor, form: of the printed table `table`; value: of (position, p_H,
    summary), None where there is none."""

    name: str
    head: str
    factor: float
    form: str
    value: Callable
    table: str

    def shown(self, *row):
        value = self.value(*row)
        return "" if value is None else value if isinstance(value, str) else format(value * self.factor, self.form)


def dig(summary, *keys):
    """A value deep in a summary, None where it is not there (or where there is no summary)."""
    for key in keys:
        summary = (summary or {}).get(key)
    return summary


def _of(*keys):
    return lambda position, p_H, summary: dig(summary, *keys)


CONTACT, STEADY, PASSAGE = TABLES = ("contact", "steady film", "while the feature passes")
COLUMNS = (
    Column("point", "at", 1, "", lambda at, *_: at.point, CONTACT),
    Column("x_pl_m", "x_pl mm", 1e3, ".3f", lambda at, *_: at.x_pl, CONTACT),
    Column("arc_m", "arc mm", 1e3, ".3f", lambda at, *_: at.arc, CONTACT),
    Column("R_m", "R' mm", 1e3, ".3f", lambda at, *_: at.R, CONTACT),
    Column("u_m_m_s", "u_m m/s", 1, ".3f", lambda at, *_: at.u_m, CONTACT),
    Column("srr", "SRR", 1, ".3f", lambda at, *_: at.srr, CONTACT),
    Column("load_N_m", "N/mm", 1e-3, ".1f", lambda at, *_: at.load, CONTACT),
    Column("p_Hertz_Pa", "p_H GPa", 1e-9, ".3f", lambda at, p_H, _: p_H, CONTACT),
    Column("steady_h_c_m", "h_c um", 1e6, ".3f", _of("steady", "h_c_m"), STEADY),
    Column("steady_h_min_m", "h_min um", 1e6, ".3f", _of("steady", "h_min_m"), STEADY),
    Column("steady_p_max_Pa", "p_max GPa", 1e-9, ".3f", _of("steady", "p_max_Pa"), STEADY),
    Column("steady_friction", "friction", 1, ".4f", _of("steady", "friction_coefficient"), STEADY),
    Column("steady_film_max_C", "film deg C", 1, ".1f", _of("steady", "film_max_C"), STEADY),
    Column("passage_h_min_m", "h_min um", 1e6, ".3f", _of("transient", "h_min_m"), PASSAGE),
    Column("passage_p_max_Pa", "p_max GPa", 1e-9, ".3f", _of("transient", "p_max_Pa"), PASSAGE),
    Column("passage_film_max_C", "film deg C", 1, ".1f", _of("transient", "film_max_C"), PASSAGE),
    Column("Fi_max", "Fi", 1, ".3f", _of("fatigue", "Fi_max"), PASSAGE),
    Column("Fi_max_below", "Fi below", 1, ".3f", _of("fatigue", "below", "Fi_max"), PASSAGE),
)


def used(rows):
    """The columns that have a value in any of the rows, (position, p_H, summary) each."""
    return [column for column in COLUMNS if any(column.value(*row) not in (None, "") for row in rows)]


def tables(rows):
    """{title: (heads, lines)} of the tables that have values, each with the positions in its first columns."""
    columns, out = used(rows), {}
    for title in TABLES:
        found = [column for column in columns if column.table == title]
        if title != CONTACT and found:
            found = [column for column in COLUMNS[:2] if column in columns] + found
        if found:
            out[title] = [column.head for column in found], [[column.shown(*row) for column in found] for row in rows]
    return out


def csv_text(rows):
    """The table as CSV in SI units, and after that what a table of positions brought along."""
    columns, more = used(rows), list(dict.fromkeys(key for at, *_ in rows for key in at.more))
    text = io.StringIO()
    out = csv.writer(text)
    out.writerow([*(column.name for column in columns), *more])
    out.writerows([*(column.value(*row) for column in columns), *(row[0].more.get(key) for key in more)] for row in rows)
    return text.getvalue()
