"""Numbers as people read them: in a unit that suits them, with as many digits as their error leaves."""

from tehl_taichi.values.digits import fitting, parted, with_error

UNITS = {"degC": "°C", "1": ""}  # of stores: as they are written


def value_text(value, error=None, unit="1", digits=4):
    """'1.008 ± 0.023 µm' of a value and its error in SI; error None: not known, then so many digits of the value."""
    factor, scale = fitting(UNITS.get(unit, unit), value)
    return with_error(value * factor, None if error is None else error * factor, scale, digits)


def apart(value, error, unit, digits=4):
    """(value, error, unit) in words: two digits of the error set the digits of the value; `digits` of it, and '' for
    the error, where that is not known."""
    factor, scale = fitting(UNITS.get(unit, unit), value)
    text, rest, power = parted(value * factor, None if error is None else error * factor, digits)
    return text + power, rest and rest + power, scale


FEW = 3  # digits of what was computed without a known error; numbers that were given have four


def roughly(value):
    """Two digits of a number (of 1) whose error is not known, more only where they would hide on which side of 1 it lies."""
    text = f"{value:.2g}"
    return text if float(text) != 1 else f"{value:.4g}"


def index(Fi, error=None):
    """An index of fatigue with its error, roughly where that is not known."""
    return roughly(Fi) if error is None else value_text(Fi, error)


def share(part, whole):
    """'1.2 %' of a whole, '' where there is none."""
    return f"{abs(part / whole) * 100:.2g} %" if whole else ""


def unit_spelled(text):
    """Text with the units of a terminal as pages spell them."""
    for plain, spelled in ((" um", " µm"), ("deg C", "°C"), ("lambda", "λ")):
        text = text.replace(plain, spelled)
    return text


def sentence_case(text):
    """Text as it begins a sentence; Greek symbols stay as they are."""
    return text[0].upper() + text[1:] if text[0].isascii() else text
