"""The tables of the pages in docs: a suite replaces its own, between two marks, and nothing else."""

import re
import shlex
import sys
import textwrap
from pathlib import Path

PAGE, PAGES = Path("docs/performance.md"), {"verdict": Path("docs/strength.md")}  # in the current folder; of other suites
END, WIDTH = "<!-- bench end -->", 130
OWN = ("--write", "--force", "--json", "--quiet", "--keep")  # options that change no figure
FOLDER = "--out"  # nor does this one, which has a value


def of(name):
    """The page with the table of a suite."""
    return PAGES.get(name, PAGE)


def check(name):
    """Raises StoreError where the page has no place for the table of a suite."""
    _around(name)


def write(name, columns, rows, keys=0):
    """Replace the table of a suite; rows: texts. keys: number of the first cells that name a row, where rows that are not
    among these stay. Raises StoreError."""
    from tehl_taichi.disk import files

    before, now, after = _around(name)
    old = _rows(now)[2:] if keys else []
    lines = [columns, ["---"] * len(columns), *_merged(old, [list(map(_cell, row)) for row in rows], keys)]
    table = "\n".join(f"| {' | '.join(line)} |" for line in lines)
    partly = " Other rows are of an earlier command." if len(lines) > len(rows) + 2 else ""
    with files.blamed(of(name)):
        files.replace(of(name), f"{before}\n{_caption(partly)}\n\n{table}\n{after}".encode())


def _merged(old, new, keys):
    """Rows of texts: the old ones with the new ones in their places, further ones behind."""
    found = {tuple(row[:keys]): row for row in new} if keys else {}
    known = [tuple(row[:keys]) for row in old]
    return [found.get(key, row) for key, row in zip(known, old)] + [row for row in new if tuple(row[:keys]) not in known]


def _rows(text):
    """Rows of cells of the table in a text, its names and rule first."""
    lines = [line.strip()[1:-1] for line in text.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)] for line in lines]


def _cell(text):
    return " ".join(str(text).replace("|", "\\|").split())


def _around(name):
    """The page up to the mark at which the table of a suite begins, that table, and from the mark at which it ends."""
    from tehl_taichi.disk import files
    from tehl_taichi.errors import StoreError

    mark, page = f"<!-- bench: {name} -->", of(name)
    with files.blamed(page, "cannot read"):
        text = files.text(page)
    before, begins, rest = text.partition(mark)
    now, ends, after = rest.partition(END)
    if not (begins and ends):
        raise StoreError(f"{page} has no table of this suite: {mark} ... {END}")
    return before + mark, now, END + after


def _caption(more=""):
    """Command, version, commit, machine and date; more: a sentence behind them."""
    from tehl_taichi.profiles import measure

    from tehl_taichi import __version__
    from tehl_taichi.commit import commit

    command = shlex.join(["tehl", *_asked(sys.argv[1:])])
    return textwrap.fill(f"`{command}`, version {__version__}, commit {commit()}; {measure.machine()}.{more}", WIDTH,
                         break_on_hyphens=False)


def _asked(words):
    """The words of a command that change a figure."""
    after_folder = {at + 1 for at, word in enumerate(words) if word == FOLDER}
    return [word for at, word in enumerate(words)
            if word not in (*OWN, FOLDER) and at not in after_folder and not word.startswith(f"{FOLDER}=")]
