"""The tables of the pages in docs: a suite replaces its own, between two marks, and nothing else."""

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


def write(name, columns, rows):
    """Replace the table of a suite; rows: texts. Raises StoreError."""
    from tehl_taichi.disk import files

    before, after = _around(name)
    lines = [columns, ["---"] * len(columns), *rows]
    table = "\n".join(f"| {' | '.join(map(_cell, line))} |" for line in lines)
    with files.blamed(of(name)):
        files.replace(of(name), f"{before}\n{_caption()}\n\n{table}\n{after}".encode())


def _cell(text):
    return " ".join(str(text).replace("|", "\\|").split())


def _around(name):
    """The page up to the mark at which the table of a suite begins, and from that at which it ends."""
    from tehl_taichi.disk import files
    from tehl_taichi.errors import StoreError

    mark, page = f"<!-- bench: {name} -->", of(name)
    with files.blamed(page, "cannot read"):
        text = files.text(page)
    before, begins, rest = text.partition(mark)
    _, ends, after = rest.partition(END)
    if not (begins and ends):
        raise StoreError(f"{page} has no table of this suite: {mark} ... {END}")
    return before + mark, END + after


def _caption():
    """Command, version, commit, machine and date."""
    from tehl_taichi.profiles import measure

    from tehl_taichi import __version__
    from tehl_taichi.commit import commit

    command = shlex.join(["tehl", *_asked(sys.argv[1:])])
    return textwrap.fill(f"`{command}`, version {__version__}, commit {commit()}; {measure.machine()}.", WIDTH)


def _asked(words):
    """The words of a command that change a figure."""
    after_folder = {at + 1 for at, word in enumerate(words) if word == FOLDER}
    return [word for at, word in enumerate(words)
            if word not in (*OWN, FOLDER) and at not in after_folder and not word.startswith(f"{FOLDER}=")]
