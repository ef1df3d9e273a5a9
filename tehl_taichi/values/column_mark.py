"""Separator of the columns in a user's table, and rows that a wrong one has cut."""

MARKS = ";", "\t", ","  # the first that a text has: with the others numbers may have decimal commas


def column_mark(text):
    """Separator of the columns in a text; None for a single column or blanks."""
    return next((mark for mark in MARKS if mark in text), None)


def wrong_length(row, count, why="as in the line of names"):
    """End of a sentence about a row with more or fewer cells than `count`; "" for a row that fits.

    Empty cells beyond the names count as none: spreadsheets end lines with separators.
    """
    if len(row) >= count and not any(row[count:]):
        return ""
    return (f"has {len(row)} column{'s' * (len(row) != 1)}; allowed: {count}, {why} (a decimal comma needs a semicolon between "
            "columns)")
