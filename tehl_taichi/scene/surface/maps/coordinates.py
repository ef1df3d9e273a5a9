"""Coordinates in a file of heights: a row and a column beside a table of heights, and lists of points."""

from dataclasses import dataclass

import numpy as np

EVEN = 0.02  # of the mean step, by which rounded coordinates depart from even ones
ALIKE = 0.01  # relative difference of steps that are one
LISTED, NARROW = 8, 64  # columns of a list of points at most; times as many rows as columns, from which on it is one
REGULAR = 0.79  # of the steps in a column of coordinates are one and the same: rows of five points or more


@dataclass(frozen=True)
class Coordinates:
    """heights: without their coordinates; x, y: distances of the coordinates along a row and from row to row, in their own
    unit; None without coordinates, or if they are only running numbers.
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
        row, column = values[0] if row else None, values[:, 0] if column else None
    heights = values[int(row is not None):, int(column is not None):]
    found_lines = [f"a {what} of coordinates ({many[0]:g} to {many[-1]:g})" for what, many in (("row", row), ("column", column))
            if many is not None]
    return Coordinates(heights, step(row), step(column), tuple(found_lines))


def _is_row(values):
    """Whether the first row contains coordinates: evenly spaced, and no continuation of the heights below."""
    if values.ndim != 2 or min(values.shape) < 5:
        return False
    first, second, third = (_even(row[1:]) for row in values[:3])
    if first is None or not (np.isnan(values[0, 0]) or _even(values[0]) is not None or _is_column(values)):
        return False
    if second is None or third is None:
        return True
    before = 2 * second - third  # where all rows are even the surface is a plane or a saddle, and this is the step before
    return abs(first - before) > ALIKE * max(abs(first), abs(second), abs(third))


def _is_column(values):
    """Whether the first column, without its corner, is evenly spaced; then the corner is a separate number."""
    return _even(values[1:, 0]) is not None


def _even(many):
    """Step of evenly rising or falling numbers, None for others."""
    steps = np.diff(many)
    step = steps.mean() if steps.size > 2 and np.isfinite(steps).all() else 0.0
    return float(step) if step and np.abs(steps - step).max() <= EVEN * abs(step) else None


def is_even(many):
    """Whether numbers rise or fall evenly."""
    return _even(many) is not None


def step(many):
    """Distance of coordinates; None if there are none or if they count from 0 or 1."""
    if many is None or many[0] in (0, 1) and _even(many) == 1:
        return None
    return abs(float((many[-1] - many[0]) / (many.size - 1)))


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
