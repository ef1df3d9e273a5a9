"""Escaping of external texts (names, notes, paths): one function for each kind of output.

Figures do not read text as mathematics (`tehl_taichi/view/figures/figure_style.py`), page templates escape their values, folder
names are checked (`checks.file_name`).
"""

import html
import re
import shlex
import unicodedata

from tehl_taichi.values.digits import is_number

FORMULA = tuple("=+-@\t\r＝＋－＠")  # a spreadsheet computes what begins so
LINES = "\n"


def printable(text, keep=""):
    """Text for terminals, pages and figures: non-printing letters (escape sequences, line breaks except those in `keep`,
    direction marks) are spelled.

    >>> printable("a\\x1b[2Jb\\n")
    'a\\\\x1b[2Jb\\\\n'
    """
    text = str(text)
    if text.isprintable():
        return text
    # a page has a million letters and a hundred kinds
    return text.translate({ord(c): c.encode("unicode_escape").decode() for c in set(text) if not _prints(c, keep)})


def _prints(c, keep):
    return c.isprintable() or c in keep or unicodedata.category(c) == "Zs"


def typed(path):
    """A path as a word of a command, never as an option.

    >>> typed("my runs/a.zarr"), typed("a.zarr"), typed("-a.zarr")
    ("'my runs/a.zarr'", 'a.zarr', './-a.zarr')
    """
    text = str(path)
    return shlex.quote(f"./{text}" if text.startswith("-") else text)


def one_line(text):
    """Message of another library without its colours and line breaks.

    >>> one_line("\\n\\x1b[31mwrong\\x1b[0m\\n  type")
    'wrong type'
    """
    return " ".join(re.sub(r"\x1b\[[\d;]*m", "", str(text)).split())


def cell(value):
    """Value for a table (CSV): text that a spreadsheet would compute begins with an apostrophe; numbers stay.

    >>> cell("=HYPERLINK(1)"), cell("-0.5"), cell(-0.5)
    ("'=HYPERLINK(1)", '-0.5', -0.5)
    """
    if not isinstance(value, str):
        return value
    text = printable(value, LINES)
    return f"'{text}" if value.lstrip(" \n").startswith(FORMULA) and not is_number(value) else text


def label(text):
    """Text for labels of plotly.js, which interprets some HTML tags."""
    return html.escape(printable(text), quote=False)
