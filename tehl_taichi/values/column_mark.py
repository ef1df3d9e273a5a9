"""Mark between two columns of a table that a user wrote."""

MARKS = ";", "\t", ","  # the first that a text has: with the others numbers may have decimal commas


def column_mark(text):
    """The mark between the columns of a text; None where it has none, as in a single column or with blanks."""
    return next((mark for mark in MARKS if mark in text), None)
