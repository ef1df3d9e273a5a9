"""Printed text of a fatigue index and of a stress in figures: known digits only, without exponent."""

import math

from tehl_taichi.values.digits import decimals

PART = "while the grid resolves the pressure"
REST = "whole passage, later pressures not resolved"
SENSE = 1000.0  # an index beyond is of no material: as of a Newtonian film that slips, whose shear has no limit


def index_text(Fi, error=None):
    """Text such as '1.008': two digits of the error if known, else two decimals; fewer for very large values."""
    if Fi >= SENSE:
        return f"{Fi:.3g}"
    known = error is not None and math.isfinite(error) and error > 0
    return f"{Fi:.{min(max(decimals(error), 0), 4) if known else 2}f}"


def resolved_words(found, whose="feature"):
    """Text of the moments in the resolved part of a search; found: its summary; whose: text of the position."""
    return f"{PART} ({whose} up to {found['to_x_a']:.2f} a)"


def error_of(found):
    """Error of the largest index in a summary, at or below the surface; None if it is not known."""
    return found.get("error", {}).get("Fi_max")


def largest(found):
    """Text of the largest index of such a summary."""
    return index_text(found["Fi_max"], error_of(found))


def mpa(stress):
    """Text of a stress (Pa) in MPa with three digits, without exponent."""
    return f"{float(f'{stress / 1e6:.3g}'):g}"
