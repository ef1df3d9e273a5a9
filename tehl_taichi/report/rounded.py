"""Numbers as people read them: in a unit that suits them, with as many digits as their error leaves."""

import math

from tehl_taichi.values.digits import decimals, fitting

UNITS = {"degC": "°C", "1": ""}  # of stores: as they are written


def told(value, error=None, unit="1", digits=4):
    """'1.008 ± 0.023 µm' of a value and its error in SI; error None: not known, then so many digits of the value."""
    text, rest, scale = apart(value, error, unit, digits)
    return f"{text} ± {rest} {scale}".rstrip() if rest else f"{text} {scale}".rstrip()


def apart(value, error, unit, digits=4):
    """(value, error, unit) in words: two digits of the error say how many of the value are told; `digits` of it, and '' for
    the error, where that is not known."""
    factor, scale = fitting(UNITS.get(unit, unit), value)
    if error is None or not math.isfinite(error):
        return f"{value * factor:.{digits}g}", "", scale
    value, error = value * factor, error * factor
    digits = decimals(error) if error > 0 else 99
    if not 0 <= digits <= 9:
        return f"{value:.4g}", f"{error:.2g}", scale
    return f"{value:.{digits}f}", f"{error:.{digits}f}", scale


FEW = 3  # digits of what was computed without a known error; numbers that were given have four


def roughly(value):
    """Two digits of a number (of 1) whose error is not known, more only where they would hide on which side of 1 it lies."""
    text = f"{value:.2g}"
    return text if float(text) != 1 else f"{value:.4g}"


def index(Fi, error=None):
    """An index of fatigue with its error, roughly where that is not known."""
    return roughly(Fi) if error is None else told(Fi, error)


def share(part, whole):
    """'1.2 %' of a whole, '' where there is none."""
    return f"{abs(part / whole) * 100:.2g} %" if whole else ""
