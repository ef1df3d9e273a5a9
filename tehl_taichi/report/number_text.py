"""Printed numbers: in a suitable unit, with as many digits as their error allows."""

from tehl_taichi.values.digits import printed_unit, rounded_parts, with_error

UNITS = {"degC": "°C", "1": ""}  # of stores: as they are written


def value_text(value, error=None, unit="1", digits=4):
    """Text such as '1.008 ± 0.023 µm' of a value and its error in SI; error None: unknown, then `digits` digits of the
    value.
    """
    factor, scale = printed_unit(UNITS.get(unit, unit), value)
    return with_error(value * factor, None if error is None else error * factor, scale, digits)


def text_parts(value, error, unit, digits=4):
    """(value, error, unit) as texts: two digits of the error set the digits of the value; unknown error: `digits` digits, and
    ''.
    """
    factor, scale = printed_unit(UNITS.get(unit, unit), value)
    text, rest, power = rounded_parts(value * factor, None if error is None else error * factor, digits)
    return text + power, rest and rest + power, scale


FEW = 3  # digits of what was computed without a known error; numbers that were given have four


def roughly(value):
    """Text of a number with unknown error: two digits, more only if rounding would hide on which side of 1 it is."""
    return next((text for digits in (2, 4, 8) if float(text := f"{value:.{digits}g}") != 1), "1")


def index(Fi, error=None):
    """Text of a fatigue index with its error, or roughly if the error is not known."""
    return roughly(Fi) if error is None else value_text(Fi, error)


def share(part, whole):
    """Text such as '1.2 %' of a whole, '' without one."""
    return f"{abs(part / whole) * 100:.2g} %" if whole else ""


def unit_spelled(text):
    """Text with the units of a terminal spelled for pages."""
    for plain, spelled in ((" um", " µm"), ("deg C", "°C"), ("lambda", "λ")):
        text = text.replace(plain, spelled)
    return text


def sentence_case(text):
    """Text with a capital first letter; Greek symbols are unchanged."""
    return text[0].upper() + text[1:] if text[0].isascii() else text
