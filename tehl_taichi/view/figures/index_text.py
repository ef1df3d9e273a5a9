"""Printed text of a fatigue index and of a stress in figures: known digits only, without exponent."""

import math

from tehl_taichi.fatigue.judged_layers import judged_points, over
from tehl_taichi.values.digits import decimals
from tehl_taichi.values.summary_values import error_of

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


def largest(found):
    """Text of the largest index of such a summary."""
    return index_text(found["Fi_max"], error_of(found, "Fi_max"))


def answer_points(found):
    """[:class:`tehl_taichi.fatigue.judged_layers.JudgedPoint`] at and below the surface whose index counts for the answer, of a
    search with this summary.
    """
    return judged_points({"": found})


def at_points(found):
    """Whether these indices are of stresses at points, as the curves and maps of the index; else of averaged stresses or a
    percentile.
    """
    return all(point.key == "Fi_max" and not point.length for point in answer_points(found))


def critical_word(found):
    """Text of the largest index of stresses at points, which is not that of the answer if averaged stresses lead."""
    return "largest at points" if any(point.length for point in answer_points(found)) else "critical point"


def judged_text(point):
    """Text of the index of such a point."""
    return f"{index_text(point.Fi, point.error)}{over(point.length)}{' (99th percentile)' * (point.key != 'Fi_max')}"


def mpa(stress):
    """Text of a stress (Pa) in MPa with three digits, without exponent."""
    return f"{float(f'{stress / 1e6:.3g}'):g}"
