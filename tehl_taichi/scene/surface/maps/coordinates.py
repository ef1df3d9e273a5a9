"""Coordinates in a file of heights: a row and a column beside a table of heights, and lists of points."""

import math
from dataclasses import dataclass
from decimal import Decimal

import numpy as np

EVEN = 0.02  # of the mean step, by which finely rounded coordinates depart from even ones
FEWEST = 8  # coarsely rounded coordinates: fewer heights of few digits are even by chance
ROUNDED, SEARCH = 1e-6, 40  # of a digit: error of the search for the step, which each trial shortens by a third
ENDS = 4  # digits by which rounding changes the step of a row against that of two others, over all its steps
STRAIGHT = 8  # digits by which rows depart from a line that are as straight as rounded coordinates
NEAR = 0.7  # of the rms of a row, by which a surface departs from the continuation of its next two rows
ALIKE = 0.01  # relative difference of steps that are one
LISTED, NARROW = 8, 64  # columns of a list of points at most; times as many rows as columns, from which on it is one
REGULAR = 0.79  # of the steps in a column of coordinates are one and the same: rows of five points or more


@dataclass(frozen=True)
class Coordinates:
    """heights: without their coordinates; x, y: distances of the coordinates along a row and from row to row, in their own
    unit, negative if they fall; None without coordinates, or if they are only running numbers.
    """

    heights: np.ndarray
    x: float | None = None
    y: float | None = None
    found_lines: tuple = ()


def separate(values):
    """Separate the coordinates from a table (rows, columns) of heights: first row or column, if they are evenly spaced. Returns
    :class:`Coordinates`.
    """
    row, column = _is_row(values), _is_row(values.T)
    if row and column:  # the corner belongs to neither
        row, column = values[0, 1:], values[1:, 0]
    else:
        row, column = _finite(values[0]) if row else None, _finite(values[:, 0]) if column else None
    heights = values[int(row is not None):, int(column is not None):]
    found_lines = [f"a {what} of coordinates ({many[0]:g} to {many[-1]:g})" for what, many in (("row", row), ("column", column))
            if many is not None]
    return Coordinates(heights, step(row), step(column), tuple(found_lines))


def _finite(many):
    """Numbers without an empty corner."""
    return many[np.isfinite(many)]


def _is_row(values):
    """Whether the first row contains coordinates: evenly spaced, and no continuation of the heights below."""
    if values.ndim != 2 or min(values.shape) < 5:
        return False
    if _even(values[0, 1:]) is None or not (np.isnan(values[0, 0]) or _even(values[0]) is not None or _is_column(values)):
        return False
    return not _continues(values[:3, 1:])


def _continues(rows):
    """Whether the first of three rows has the step that the other two lead to: their surface is a plane or a saddle."""
    digit, exact = _coarsest(rows[0]), [_is_exact(row) for row in rows]
    if not all(_even(row) if exact[0] else _departure(row) <= STRAIGHT * digit for row in rows[1:]):
        return False
    first, second, third = map(_slope, rows)
    rounding = 0.0 if all(exact) else ENDS * digit / (rows.shape[1] - 1)
    return abs(first - (2 * second - third)) <= ALIKE * max(abs(first), abs(second), abs(third)) + rounding


def _is_column(values):
    """Whether the first column, without its corner, is evenly spaced; then the corner is a separate number."""
    return _even(values[1:, 0]) is not None


def uneven(values):
    """Text such as 'row from 0 to 0.064' for a first row or column that has an empty corner and rises or falls, but is neither
    even nor a continuation of the heights beside it; "" without one.
    """
    if values.ndim != 2 or min(values.shape) < 5 or not np.isnan(values[0, 0]):
        return ""
    for name, table in (("row", values), ("column", values.T)):
        many = table[0, 1:]
        if not _is_row(table) and _is_monotonic(many) and not _follows(table[:3, 1:]):
            return f"{name} from {many[0]:g} to {many[-1]:g}"
    return ""


def _is_monotonic(many):
    """Whether numbers rise or fall, in half of their steps at least: coarse digits repeat some."""
    steps = np.diff(many) * np.sign(many[-1] - many[0])
    return many.size >= FEWEST and bool((steps >= 0).all() and (steps > 0).mean() >= 0.5)


def _follows(rows):
    """Whether the first of three rows has the shape of the continuation of the other two, as on a tilted or curved surface."""
    off = _finite(rows[0] - (2 * rows[1] - rows[2]))
    return off.size > 0 and bool(off.std() <= NEAR * rows[0].std())


def _even(many):
    """Step of evenly rising or falling numbers, perhaps rounded to their printed digits; None for others."""
    step = _mean_step(many)
    return step if step and (_is_exact(many) or _is_rounded(many, step)) else None


def _is_exact(many):
    """Whether all steps are equal within a small share."""
    step = _mean_step(many)
    return bool(step and np.abs(np.diff(many) - step).max() <= EVEN * abs(step))


def _mean_step(many):
    steps = np.diff(many)
    return float(steps.mean()) if steps.size > 2 and np.isfinite(steps).all() else 0.0


def _is_rounded(many, step):
    """Whether there are even numbers from which these differ by half of their last digit at most.

    The ends are rounded, too: their step is searched around the mean one, where the smallest gap is a convex function of it.
    """
    if many.size < FEWEST or (np.diff(many) * step < 0).any():
        return False
    digits = last_digits(many)
    low, high = (step + side * digits.max() / (many.size - 1) for side in (-1, 1))
    count = np.arange(many.size)

    def gap(trial):
        """Difference of the lower and the upper bound of the first number; 0 or less if it can exist."""
        first = many - trial * count
        return (first - digits / 2).max() - (first + digits / 2).min()

    for _ in range(SEARCH):
        one, other = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, other) if gap(one) < gap(other) else (one, high)
    return bool(gap(0.5 * (low + high)) <= ROUNDED * digits.max())


def last_digits(many):
    """Size of the last printed digit of each number, 1 at most: all have equal decimals, or equal significant digits, if that
    is coarser.
    """
    found = [Decimal(repr(float(value))).normalize() for value in many]
    leading = np.array([value.adjusted() if value else -math.inf for value in found])
    counts = np.array([len(value.as_tuple().digits) for value in found])
    finest = np.where(many != 0, leading - counts + 1, 0).min()  # zero shows no digits
    return 10.0 ** np.minimum(np.maximum(finest, leading - counts.max() + 1), 0)


def _coarsest(many):
    """Largest of the last digits of the finite numbers; 0 without any."""
    known = many[np.isfinite(many)]
    return float(last_digits(known).max()) if known.size else 0.0


def _slope(many):
    """Step of the straight line through the finite numbers; nan for fewer than three."""
    known = np.flatnonzero(np.isfinite(many))
    if known.size < 3:
        return math.nan
    away = known - known.mean()
    return float(away @ many[known] / (away @ away))


def _departure(many):
    """Largest distance of the finite numbers from that line; nan for fewer than three."""
    off = (many - _slope(many) * np.arange(many.size))[np.isfinite(many)]
    return float(np.abs(off - off.mean()).max()) if off.size else math.nan


def is_even(many):
    """Whether numbers rise or fall evenly."""
    return _even(many) is not None


def step(many):
    """Distance of coordinates, negative if they fall; None if there are none or if they count from 0 or 1."""
    if many is None or many[0] in (0, 1) and _even(many) == 1:
        return None
    return float((many[-1] - many[0]) / (many.size - 1))


def is_narrow(values):
    """Whether a table has so few columns (or rows) that it may be a list of points."""
    return values.ndim == 2 and 2 < min(values.shape) <= LISTED and max(values.shape) > 2 * min(values.shape)


def is_list(values):
    """Whether a table (rows, columns) is a list of points: x and y beside z, in any order, perhaps with further columns."""
    if not is_narrow(values):
        return False
    long = values if values.shape[0] >= values.shape[1] else values.T
    rows, columns = long.shape
    return rows >= NARROW * columns or any(map(_is_stepped, long.T)) and any(map(_is_cyclic, long.T))


def _is_stepped(many):
    """Whether a column of coordinates is constant over several rows, then makes a step, repeatedly."""
    steps = np.diff(many)
    return bool(np.isfinite(steps).all() and steps.any() and (steps == 0).mean() >= REGULAR)


def _is_cyclic(many):
    """Whether a column runs in equal steps and returns to its beginning, repeatedly."""
    steps = np.diff(many)
    if not np.isfinite(steps).all() or not (usual := np.median(steps)):
        return False
    return bool(REGULAR <= (np.abs(steps - usual) <= EVEN * abs(usual)).mean() < 1)
