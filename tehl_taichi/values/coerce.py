"""Conversion of values to plain Python types, and to text for sentences."""

import os
import re
import reprlib

import numpy as np

from tehl_taichi.values.estimate import Quantity

LINES = re.compile(r"\n\s*")  # between rows of an array
DEEPEST = 8  # lists inside lists: nothing in a scene needs more than two


def plain(value, depth=0):
    """`value` without numpy: its scalars as bool, int, float or str, arrays (also of pandas or xarray), lists and ranges as
    tuples, masked values as None, paths as text. A :class:`Quantity` becomes a text with its unit, without one its number.
    """
    if isinstance(value, Quantity):
        value = f"{float(value)!r} {value.unit}" if value.unit else value.value
    if hasattr(value, "__array__"):
        value = float(value) if isinstance(value, np.longdouble) else np.asanyarray(value).tolist()
    if isinstance(value, (list, tuple, range)) and depth < DEEPEST:
        return tuple(plain(item, depth + 1) for item in value)
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def listed(value):
    """Tuple of the entries of a list, an array or a range; of one value."""
    value = plain(value)
    return value if isinstance(value, tuple) else (value,)


def shown(value):
    """repr of any value, in one line of bounded length."""
    try:
        return LINES.sub(" ", _short.repr(list(value) if isinstance(value, tuple) else value))
    except ValueError:  # Python does not print numbers of more than 4300 digits
        return "a number of thousands of digits"


def text_of(value):
    """The value if it is text, else "" (which the caller refuses)."""
    return value if isinstance(value, str) else ""


_short = reprlib.Repr()
_short.maxstring = _short.maxother = 70
_short.maxlevel = 3
