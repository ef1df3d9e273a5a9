"""Result tables on pages of the documentation: a suite replaces only its own table, between two marks."""

import re
import shlex
import sys
import textwrap
from pathlib import Path

from tehl_taichi import __version__
from tehl_taichi.commit import commit
from tehl_taichi.errors import StoreError

PAGE, PAGES = Path("docs/performance.md"), {"verdict": Path("docs/strength.md")}  # in the current folder; of other suites
END, WIDTH = "<!-- bench end -->", 130
OWN = ("--write", "--force", "--json", "--quiet", "--keep")  # options that change no figure
FOLDER = "--out"  # nor does this one, which has a value


def of(name):
    """Page with the table of a suite."""
    return PAGES.get(name, PAGE)


def check(name):
    """Raise StoreError if the page has no place for the table of a suite."""
    _split_page(name)


def write(name, columns, rows, keys=0):
    """Replace the table of a suite. Raises StoreError.

    rows: texts; keys: number of leading cells that identify a row; old rows that are not among the new ones stay.
    """
    from tehl_taichi.profiles import measure

    from tehl_taichi.disk import files

    before, now, after = _split_page(name)
    old = _rows(now)[2:] if keys else []
    lines = _merged(old, [list(map(_cell, row)) for row in rows], keys)
    table = "\n".join(measure.markdown(columns, lines))
    partly = " Other rows are of an earlier command." if len(lines) > len(rows) else ""
    with files.disk_errors(of(name)):
        files.replace(of(name), f"{before}\n{_caption(partly)}\n\n{table}\n{after}".encode())


def _merged(old, new, keys):
    """Old rows with the new ones in their places, further new ones at the end."""
    found = {tuple(row[:keys]): row for row in new} if keys else {}
    known = [tuple(row[:keys]) for row in old]
    return [found.get(key, row) for key, row in zip(known, old)] + [row for row in new if tuple(row[:keys]) not in known]


def _rows(text):
    """Rows of cells of the table in a text, without its head."""
    lines = [line.strip()[1:-1] for line in text.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)] for line in lines]


def _cell(text):
    return " ".join(str(text).replace("|", "\\|").split())


def _split_page(name):
    """(page up to the start mark of a suite's table, the table, page from its end mark)."""
    from tehl_taichi.disk import files

    mark, page = f"<!-- bench: {name} -->", of(name)
    with files.disk_errors(page, "cannot read"):
        text = files.text(page)
    before, begins, rest = text.partition(mark)
    now, ends, after = rest.partition(END)
    if not (begins and ends):
        raise StoreError(f"{page} has no table of this suite: {mark} ... {END}")
    return before + mark, now, END + after


def _caption(more=""):
    """Caption: command, version, commit, machine and date; more: a further sentence."""
    from tehl_taichi.profiles import measure

    command = shlex.join(["tehl", *_significant_words(sys.argv[1:])])
    return textwrap.fill(f"`{command}`, version {__version__}, commit {commit()}; {measure.machine()}.{more}", WIDTH,
                         break_on_hyphens=False)


def _significant_words(words):
    """Words of a command that affect a figure."""
    after_folder = {at + 1 for at, word in enumerate(words) if word == FOLDER}
    return [word for at, word in enumerate(words)
            if word not in (*OWN, FOLDER) and at not in after_folder and not word.startswith(f"{FOLDER}=")]
