"""Printed tables."""

import os

from tehl_cli.stdout import put

from tehl_taichi.values.escape import printable

MOST = 240  # columns of a table in a file
NAME = 40  # characters of a first column that is not broken; sentences are
WORD = 12  # characters of words that are never broken: half a number would be read as another one


def cell(text, keep=""):
    """Text of a table cell, unchanged: [brackets] are no markup of rich."""
    from rich.text import Text

    return Text(printable(text, keep))


def _table(title, rows):
    from rich.console import Console
    from rich.table import Table

    table = Table(title=cell(title), title_justify="left")
    table.add_column("quantity")
    table.add_column("value", justify="right")
    for row in rows:
        table.add_row(*map(cell, row))
    Console().print(table)


def summary_table(summary, printed=()):
    """Print the summary of a run; printed: warnings that were printed before."""
    from tehl_taichi.runs.summary.summary_rows import summary_rows, title

    _table(title(summary), summary_rows(summary))
    answer(summary)
    warning_lines([sentence for sentence in summary.get("warnings", []) if sentence not in printed])


def answer(summary):
    """Print the answer of a passage, as in its report."""
    from tehl_taichi.fatigue.judged_surfaces import others
    from tehl_taichi.report.verdict import of_fatigue

    if "fatigue" in summary:
        question, headline, *_ = of_fatigue(summary["fatigue"], beside=others(summary))
        put(f"{question} {headline}")


def warning_lines(sentences):
    """Print warnings below a table, a line each."""
    for sentence in sentences:
        put(f"warning: {sentence}")


def print_places(found, tables, answer, more=(), assumed=()):
    """Print the tables of a flank or a cam, its answer, its assumptions, positions without a result, warnings, and its path.

    more, assumed: further sentences after the answer and after the assumption.
    """
    from tehl_taichi.report import place_page

    put(found.title)
    for title, (heads, lines) in tables.items():
        list_table(title, heads, lines, whole=True)
    for sentence in (f"{answer.question} {answer.headline}", *filter(None, answer.sentences), *place_page.limits(found), *more,
                     f"assumed: {found.record['assumption']}", *assumed):
        put(sentence)
    for at, reason in found.failed:
        put(f"no result: {at.full}: {reason}")
    warning_lines(place_page.warnings(found, str))
    put(f"stores, {found.KIND}.csv, {found.KIND}.json: {found.folder}")


def print_wrapped(sentence):
    """Print a sentence within the width of the terminal, with further lines indented."""
    import shutil
    import textwrap

    width = max(shutil.get_terminal_size().columns, NAME)
    put(textwrap.fill(sentence, width, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False), "\n")


def list_table(title, columns, rows, whole=False):
    """Print rows under column names; whole: without a terminal, the table is as wide as its contents."""
    from rich.console import Console
    from rich.table import Table

    table = Table(title=cell(title, "\n"), title_justify="left")
    names = all(len(row[0]) <= NAME for row in rows)
    for n, column in enumerate(columns):
        words = [len(word) for text in (column, *(row[n] for row in rows)) for word in str(text).split()]
        table.add_column(cell(column), no_wrap=n == 0 and names, overflow="fold",
                         min_width=max((size for size in words if size <= WORD), default=None))
    for row in rows:
        table.add_row(*map(cell, row))
    console = Console()
    if whole and not console.is_terminal and "COLUMNS" not in os.environ:
        console = Console(width=max(console.width, Console(width=MOST).measure(table).maximum))
    console.print(table, crop=False)


# scalar in the store -> column, factor, format
HISTORY = (("step", "step", 1, ".0f"), ("p_max_Pa", "p_max GPa", 1e-9, ".4f"), ("h_min_m", "h_min um", 1e6, ".4f"),
           ("residual", "residual", 1, ".0e"), ("load_error", "load", 1, ".0e"), ("mass_error", "mass", 1, ".0e"),
           ("newton", "Newton", 1, ".0f"), ("cycles", "Krylov", 1, ".0f"))


def history_table(scalar, entries):
    """Print scalars of some entries of a store; scalar(name) gives their values."""
    columns = [(scalar(name), factor, form) for name, _, factor, form in HISTORY]
    list_table("history", [title for _, title, _, _ in HISTORY],
               [[format(float(values[n]) * factor, form) for values, factor, form in columns] for n in entries])
