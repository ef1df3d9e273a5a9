"""Separator of the columns in a user's table."""

MARKS = ";", "\t", ","  # the first that a text has: with the others numbers may have decimal commas


def column_mark(text):
    """Separator of the columns in a text; None for a single column or blanks."""
    return next((mark for mark in MARKS if mark in text), None)
