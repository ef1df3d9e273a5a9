"""Text of an index of fatigue and of a stress in figures: with as many digits as are known, and without an exponent."""

import math

from tehl_taichi.values.digits import decimals

PART = "while the grid resolves the pressure"
REST = "whole passage, later pressures not resolved"
SENSE = 1000.0  # an index beyond is of no material: as of a Newtonian film that slips, whose shear has no limit


def index_text(Fi, error=None):
    """'1.008': with two digits of the error, where that is known, else with two decimals; not all of a number without sense."""
    if Fi >= SENSE:
        return f"{Fi:.3g}"
    known = error is not None and math.isfinite(error) and error > 0
    return f"{Fi:.{min(max(decimals(error), 0), 4) if known else 2}f}"


def resolved(found, whose="feature"):
    """Which moments the resolved part of a search has; found: its summary; whose: position it is, in words."""
    return f"{PART} ({whose} up to {found['to_x_a']:.2f} a)"


def error_of(found):
    """Error of the largest index in a summary of the surface or of what lies below, None where it is not known."""
    return found.get("error", {}).get("Fi_max")


def largest(found):
    """The largest index of such a summary."""
    return index_text(found["Fi_max"], error_of(found))


def mpa(stress):
    """Three digits of a stress (Pa) in MPa, and 1250, not 1.25e+03."""
    return f"{float(f'{stress / 1e6:.3g}'):g}"
