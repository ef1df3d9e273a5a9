"""Numbers in texts: their units, and their number of digits, with and without an error."""

import math

# of SI units: (up to below this size, factor, unit that people read)
SCALES = {"m": ((1e-3, 1e6, "µm"), (1.0, 1e3, "mm")), "Pa": ((1e9, 1e-6, "MPa"), (math.inf, 1e-9, "GPa")),
          "m2/s": ((math.inf, 1e6, "mm²/s"),), "1/Pa": ((math.inf, 1e9, "1/GPa"),),
          "N/m": ((1e3, 1.0, "N/m"), (math.inf, 1e-3, "N/mm"))}


def printed_unit(unit, size):
    """(factor, unit) for numbers of about `size` in the SI unit `unit`: 2e9 Pa are printed in GPa."""
    known = ((factor, shown) for below, factor, shown in SCALES.get(unit, ()) if abs(size) < below)
    return next(known, (1.0, unit))


def is_number(text):
    """Whether a text is a number to Python."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def number_of(count, one, many=""):
    """Text of a count with its noun; many: plural of `one`, if it is not made by an s.

    >>> number_of(1, "case"), number_of(2, "case"), number_of(2, "point is", "points are")
    ('1 case', '2 cases', '2 points are')
    """
    return f"{count} {one if count == 1 else many or f'{one}s'}"


def part_of(count, total, noun, *verbs):
    """Text of a part of a total; verbs: that of one and that of several.

    >>> part_of(1, 3, "case", "has", "have"), part_of(2, 3, "case", "has", "have"), part_of(1, 1, "case")
    ('1 of 3 cases has', '2 of 3 cases have', '1 of 1 case')
    """
    return " ".join((f"{count} of {number_of(total, noun)}", *verbs[count != 1:][:1]))


def micrometres(length):
    """Text of a length (m) in whole micrometres; below ten with two digits."""
    return f"{length * 1e6:.0f}" if length >= 9.95e-6 else f"{length * 1e6:.2g}"


def decimals(error):
    """Number of decimals for two digits of an error > 0; may be negative."""
    return 1 - math.floor(math.log10(error))


NOTHING, EXACT = 1e-12, 1e-8  # sizes that are rounding: of a number in the unit it is shown in, of an error over its number
PLAIN = (1e-3, 1e6)  # numbers between these are shown without an exponent


def with_error(value, error, unit="", digits=4):
    """Text such as '1.008 ± 0.023 µm': two digits of the error, and the value with as many decimals; `digits` digits of the
    value if the error is not known (None).
    """
    text, rest, power = rounded_parts(value, error, digits)
    both = f"{text} ± {rest}" if rest else text
    return f"{f'({both}){power}' if power and rest else both + power} {unit}".rstrip()


def with_bar(text, error):
    """The text of a number that has an error bar, with a mark in tables if that is not known (None or nan): '1.008 ± ?'."""
    return text if error is not None and math.isfinite(error) else f"{text} ± ?"


def rounded_parts(value, error, digits=4):
    """(value, error, power of ten) as texts for :func:`with_error`; error "": not known."""
    if error is None or not math.isfinite(error) or not math.isfinite(value):
        return f"{value:.{digits}g}", "", ""
    size = max(abs(value), error)
    if size < NOTHING:
        return "0", "0", ""
    if error < EXACT * size:
        return f"{value:.{digits}g}", "0", ""
    exponent = 0 if PLAIN[0] <= size < PLAIN[1] else math.floor(math.log10(size))
    value, error = value / 10.0**exponent, error / 10.0**exponent
    places = decimals(float(f"{error:.1e}"))
    shown = [f"{round(number, places):.{max(places, 0)}f}" for number in (value, error)]
    return *shown, f"e{exponent:+03d}" if exponent else ""
