"""What is told of a position, a column each: for the table on the screen, the CSV file and the figure."""

import csv
from dataclasses import dataclass
from typing import Callable


@dataclass(frozen=True)
class Column:
    """name: with its SI unit, of the CSV file; head, factor, form: of the printed table; value: of (position, p_H, summary),
    None where there is none."""

    name: str
    head: str
    factor: float
    form: str
    value: Callable

    def shown(self, *row):
        value = self.value(*row)
        return "" if value is None else value if isinstance(value, str) else format(value * self.factor, self.form)


def _of(part, key):
    """A value of one part of a summary."""
    return lambda position, p_H, summary: (summary or {}).get(part, {}).get(key)


def _hottest(position, p_H, summary):
    """Largest temperature of the film while the feature passes, of the steady film where none does."""
    passed = _of("transient", "film_max_C")(position, p_H, summary)
    return _of("steady", "film_max_C")(position, p_H, summary) if passed is None else passed


COLUMNS = (
    Column("point", "at", 1, "", lambda at, *_: at.point),
    Column("x_pl_m", "x_pl mm", 1e3, ".3f", lambda at, *_: at.x_pl),
    Column("arc_m", "arc mm", 1e3, ".3f", lambda at, *_: at.arc),
    Column("R_m", "R' mm", 1e3, ".3f", lambda at, *_: at.R),
    Column("u_m_m_s", "u_m m/s", 1, ".3f", lambda at, *_: at.u_m),
    Column("srr", "SRR", 1, ".3f", lambda at, *_: at.srr),
    Column("load_N_m", "N/mm", 1e-3, ".1f", lambda at, *_: at.load),
    Column("p_Hertz_Pa", "p_H GPa", 1e-9, ".3f", lambda at, p_H, _: p_H),
    Column("steady_h_c_m", "h_c um", 1e6, ".3f", _of("steady", "h_c_m")),
    Column("steady_h_min_m", "h_min um", 1e6, ".3f", _of("steady", "h_min_m")),
    Column("steady_p_max_Pa", "p_max GPa", 1e-9, ".3f", _of("steady", "p_max_Pa")),
    Column("friction_coefficient", "friction", 1, ".4f", _of("steady", "friction_coefficient")),
    Column("film_max_C", "film deg C", 1, ".1f", _hottest),
    Column("passage_h_min_m", "passage h_min um", 1e6, ".3f", _of("transient", "h_min_m")),
    Column("passage_p_max_Pa", "passage p_max GPa", 1e-9, ".3f", _of("transient", "p_max_Pa")),
    Column("Fi_max", "Fi", 1, ".3f", _of("fatigue", "Fi_max")),
)


def used(rows):
    """The columns that have a value in any of the rows, (position, p_H, summary) each."""
    return [column for column in COLUMNS if any(column.value(*row) not in (None, "") for row in rows)]


def write_csv(path, rows):
    """A CSV file in SI units, and after that what a table of positions brought along."""
    columns, more = used(rows), list(dict.fromkeys(key for at, *_ in rows for key in at.more))
    with path.open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow([*(column.name for column in columns), *more])
        out.writerows([*(column.value(*row) for column in columns), *(row[0].more.get(key) for key in more)] for row in rows)
