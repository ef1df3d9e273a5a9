"""Separator of the columns in a user's table, and rows that a wrong one has cut."""

MARKS = ";", "\t", ","  # the first that a text has: with the others numbers may have decimal commas


def column_mark(text):
    """Separator of the columns in a text; None for a single column or blanks."""
    return next((mark for mark in MARKS if mark in text), None)


def without_empty_end(names):
    """Names of columns without empty ones at the end: spreadsheets end lines with separators."""
    last = max((n for n, name in enumerate(names, 1) if name), default=0)
    return names[:last]


def wrong_length(row, count, why="as in the line of names"):
    """End of a sentence about a row with more or fewer cells than `count`; "" for a row that fits.

    Empty cells beyond the names count as none, as in :func:`without_empty_end`.
    """
    if len(row) >= count and not any(row[count:]):
        return ""
    return (f"has {len(row)} column{'s' * (len(row) != 1)}; allowed: {count}, {why} (a decimal comma needs a semicolon between "
            "columns)")
