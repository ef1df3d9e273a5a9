"""Differences between the results of runs, in the terms of their summaries: rows with a value per run."""

from dataclasses import dataclass

from tehl_taichi.runs.compare_change import change
from tehl_taichi.runs.summary.summary_rows import rows_of

NONE = "-"  # of a run that has no such value (yet)


@dataclass(frozen=True)
class ComparisonRow:
    """what: the quantity; values: a text for each run; change: between two runs, "" if it has no meaning."""

    what: str
    values: tuple
    change: str = ""

    @property
    def same(self):
        return len(set(self.values)) == 1


def lines(summaries):
    """List of :class:`ComparisonRow` of the summaries of runs ({} for an unfinished one), in the order of `tehl show`."""
    runs = [{(row.part, row.what): row for row in rows_of(summary)} if summary else {} for summary in summaries]
    keys = merged_order([list(run) for run in runs])
    return [_line(what, [run.get(key) for run in runs]) for key, what in zip(keys, _with_parts(keys))]


def _with_parts(keys):
    """Texts of the quantities (part, quantity), with the part if the quantity occurs in an earlier part."""
    seen = set()
    for part, what in keys:
        yield f"{what}, {part}" if what in seen else what
        seen.add(what)


def merged_order(lists):
    """Every key once: those of the first list; others after the key that they follow in their list."""
    out = list(lists[0])
    for keys in lists[1:]:
        for n, key in enumerate(keys):
            if key not in out:
                out.insert(out.index(keys[n - 1]) + 1 if n else 0, key)
    return out


def _line(what, rows):
    """Row of a quantity. rows: a SummaryRow or None for each run; a common position of their values is printed once."""
    places = {row.where for row in rows if row}
    once = places.pop() if len(places) == 1 else None
    values = tuple(NONE if row is None else row.value + ("" if once is not None else row.where) for row in rows)
    return ComparisonRow(what + (once or ""), values, _change(rows))


def _change(rows):
    """Text of the change from the first number to the second."""
    if len(rows) != 2 or any(row is None or row.number is None for row in rows):
        return ""
    first, second = rows
    return change((first.number, first.error), (second.number, second.error), first.nothing)
