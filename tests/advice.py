"""Values that a warning advises in Python."""

import re


def advised(key, text):
    """Number of `grid.key=number` in a text."""
    return float(re.search(rf"grid\.{key}=([-\d.]*\d)", text)[1])
