"""Display of a sweep: in a terminal a bar with the remaining time and the last cases, otherwise plain lines; its table."""

import itertools
import math
import sys
import time
from collections import deque
from typing import Any

from tehl_cli.live_display import say
from tehl_cli.stdout import put
from tehl_cli.tables import cell, list_table

from tehl_taichi.errors import Interrupted, stopped
from tehl_taichi.runs.sweep import main_effects, repeated_cases
from tehl_taichi.runs.sweep.axis_syntax import short_word
from tehl_taichi.runs.sweep.study_labels import column_name, key_unit
from tehl_taichi.runs.sweep.summary_columns import JUDGED, error_of
from tehl_taichi.values.digits import number_of, part_of, with_bar
from tehl_taichi.values.escape import typed

SHOWN = ((JUDGED, "Fi judged", 1), ("transient_h_min_m", "h_min um", 1e6), ("transient_p_max_Pa", "p_max GPa", 1e-9),
         ("steady_h_c_m", "steady h_c um", 1e6))
STEADY = (("steady_p_max_Pa", "steady p_max GPa", 1e-9), ("steady_friction_coefficient", "steady friction", 1),
          ("steady_film_max_C", "steady film deg C", 1), ("contact_alone_Fi_max", "contact alone Fi", 1))  # without a passage
LAST, MOST_ROWS = 8, 60


class SweepLive:
    """Listener of a sweep: called with (study, record of the completed case, or None at the start). As a context manager it
    turns Ctrl-C into Interrupted; resume: how to resume then (default: as a sweep).
    """

    EVERY = 5.0  # s between plain lines; failures are printed at once

    def __init__(self, quiet=False, resume=""):
        self.quiet, self.resume, self.ended, self.printed_at = quiet, resume, 0, 0.0
        self.first: float = 0.0  # when the first case ended
        self.rows: deque[dict] = deque(maxlen=LAST)
        self.live: Any = None
        self.study: Any = None

    def __enter__(self):
        return self

    def __exit__(self, kind, error, _):
        if self.live:
            self.live.stop()
            self.live = None
        if isinstance(error, KeyboardInterrupt):
            raise Interrupted(f"{stopped(error)} {self._left()}") from None

    def __call__(self, study, record):
        self.study = study
        if record is None:
            return self._start()
        self.ended += 1
        self.first = self.first or time.monotonic()
        self.rows.append(record)
        if self.live:
            self.live.update(self._view())
        elif not self.quiet and (record["status"] != "converged" or time.monotonic() - self.printed_at > self.EVERY):
            self.printed_at = time.monotonic()
            say(f"{self._headline()}  {case_words(record)}: {record['status']} {record['reason']}".rstrip())

    def _start(self):
        study, todo = self.study, len(self.study.open_cases)
        if not self.quiet:
            done = f", {len(study) - todo} of them already done" if len(study) > todo else ""
            say(f"{number_of(len(study), 'case')} into {study.path}{done}")
        for record in study.results():
            if record["status"] == "refused":
                say(f"case {record['case']} was refused: {record['reason']}")
        if not self.quiet and todo and sys.stderr.isatty():
            from rich.console import Console
            from rich.live import Live

            self.live = Live(self._view(), console=Console(stderr=True), refresh_per_second=4)
            self.live.start()

    def _headline(self):
        left, study = len(self.study.open_cases), self.study
        text = f"{len(study) - left}/{number_of(len(study), 'case')}"
        bad = sum(count for word, count in study.counts.items() if word not in ("converged", "waiting"))
        text += f", {bad} without a result" if bad else ""
        if self.ended > 2 and left:  # the start of the workers does not count in the pace
            text += f", {duration((time.monotonic() - self.first) / (self.ended - 1) * left)} left"
        return text

    def _view(self):
        from rich.console import Group
        from rich.progress_bar import ProgressBar
        from rich.table import Table

        table = Table()
        for title in ("case", "changes", "status", "s"):
            table.add_column(title)
        for record in self.rows:
            table.add_row(*map(cell, (record["case"], changes_words(record), record["status"], f"{record['seconds']:.1f}")))
        foot = Table.grid(padding=(0, 2))
        done = len(self.study) - len(self.study.open_cases)
        foot.add_row(ProgressBar(total=len(self.study), completed=done, width=30), self._headline())
        return Group(table, foot)

    def _left(self):
        """End of a sentence about a stopped sweep: completed cases, and how to resume."""
        if self.study is None:
            return "before any result was stored"
        done, path = len(self.study) - len(self.study.open_cases), typed(self.study.path)
        return f"after {part_of(done, len(self.study), 'case')}; {self.resume or f'resume with: tehl sweep {path}'}"


def changes_words(record):
    """Keys and values of a case as text."""
    return ", ".join(f"{key} = {short_word(value)}" for key, value in record["changes"].items())


def case_words(record):
    """Text of a case."""
    return f"case {record['case']} ({changes_words(record)})"


def duration(seconds):
    """Text of a remaining time, in a suitable unit."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def doubts(plan):
    """Warnings about keys without effect, in all cases or in some of them."""
    yield from plan.doubts()
    yield from repeated_cases.sentences(plan)
    if some := plan.without_temperatures():
        yield (f"{_cases(some)} no temperatures, the other cases do; use --thermal to compute them in all cases, "
               "--isothermal in none")


def _cases(numbers):
    """Text of cases by their numbers, with the verb."""
    few = ", ".join(map(str, numbers[:8])) + ", ..." * (len(numbers) > 8)
    return f"case {few} computes" if len(numbers) == 1 else f"cases {few} compute"


def print_study(study):
    """Print the table of a study, the reasons of missing results, and its path."""
    columns = columns_of(study)
    rows = [_cells(study, row, columns) for row in itertools.islice(study.rows(), MOST_ROWS)]
    heads = ("case", *key_heads(study.plan), "status", *(title for _, title, _ in columns))
    list_table(f"{study.path}", heads, rows, whole=True)
    if len(study) > MOST_ROWS:
        put(f"and {len(study) - MOST_ROWS} more in {study.table}")
    _print_effects(study)
    for record in study.results():
        if not record["converged"]:
            put(f"{case_words(record)}: {record['status']}: {record['reason']}")
    put(f"table: {study.table}; figures: tehl plot {typed(study.path)}")


def key_heads(plan):
    """Heads of the columns of the keys, with units as of the numbers beside them: "load N/m"."""
    return [f"{key} {key_unit(plan.scene, key)}".rstrip() for key in plan.keys]


def columns_of(study):
    """The (column, head, factor) of the numbers that the table of a study shows."""
    passes = any(name.startswith("transient_") for name in study.values)
    return [entry for entry in (*SHOWN, *STEADY * (not passes)) if entry[0] in study.values]


def _print_effects(study):
    """Print which key matters: the share of the spread of each usual result that it accounts for; nothing without shares."""
    found = main_effects.usual_effects(study)
    axes = list(dict.fromkeys(keys for one in found.values() for keys in one.shares))
    rows = [[column_name(name), *(f"{one.shares[keys]:.0%}" for keys in axes),
             "" if one.together is None else f"{one.together:.0%}"] for name, one in found.items()]
    if rows:
        list_table("share of the spread", ("result", *(", ".join(keys) for keys in axes), "keys together"), rows, whole=True)


def _number(value, error):
    """Value with its error; empty without a value."""
    from tehl_taichi.report.number_text import value_text

    return "" if math.isnan(value) else with_bar(value_text(value, error), error)


def _cells(study, row, columns):
    keys = (short_word(row[key]) for key in study.plan.keys)
    numbers = (_number(row[name] * factor, row.get(error_of(name), math.nan) * factor) for name, _, factor in columns)
    return [str(row["case"]), *keys, "ok" if row["status"] == "converged" else row["status"], *numbers]
