"""Arrays of numbers: those that a caller gives, and places in them."""

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.values.coerce import shown

NO_NUMBERS = "cmM"  # kinds of numpy: complex numbers, whose imaginary part would be lost, and times


def floats(where, values, allowed):
    """`values` as an array of floats, nan where they are masked. Raises SceneError for anything else.

    where: name of the values, allowed: description of allowed ones, both for the message.

    >>> floats("p", np.ma.array([1, 2], mask=[False, True]), "numbers")
    array([ 1., nan])
    """
    try:
        found = np.ma.asarray(values)
        if found.dtype.kind in NO_NUMBERS:
            raise TypeError
        return np.asarray(np.ma.filled(found.astype(float, copy=False), np.nan))
    except (ValueError, TypeError, OverflowError):
        raise SceneError(f"{where} = {shown(values)} must be {allowed}") from None


def nearest_index(places, to):
    """Number of the entry of `places` (n,) that is nearest to `to`."""
    return int(np.argmin(np.abs(places - to)))
