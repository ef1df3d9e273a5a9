"""Markdown takes lists and tables without an empty line before them for text; such pages are refused."""

import re

TEXT = re.compile(r"<p>((?:(?!</p>).)*)</p>", re.DOTALL)
ROW = re.compile(r"^(?:[*-] |\d+\. |\|.*\|\s*$)", re.MULTILINE)


def checked(page):
    """The HTML of a page as it is. Raises ValueError with the line that should begin a list or a table."""
    for paragraph in TEXT.findall(page):
        if row := ROW.search(paragraph):
            line = paragraph[row.start():].splitlines()[0]
            raise ValueError(f"no empty line before {line[:60]!r}")
    return page
