"""Line profiles in tables of numbers: heights alone, or with the positions of a stylus."""

import numpy as np

from tehl_taichi.scene.surface.maps import coordinates

FEWEST = 8  # heights
EVEN = 0.05  # of a step, by which places (in `coordinates`: steps) are off without any harm
UNEVEN = "uneven distances (heights interpolated at even ones)"


def heights_of(values):
    """(heights (1, points), their distance in the unit of the positions or None, description of other columns).

    Accepts one row, one column, or two columns (positions, heights), perhaps after running numbers. None if a table has no line
    profile.
    """
    columns = np.atleast_2d(values).T if values.ndim == 1 or values.shape[0] < 3 else values
    if columns.ndim != 2 or len(columns) < FEWEST:
        return None
    numbered = columns.shape[1] == 3 and _counts(columns[:, 0]) and _rises(columns[:, 1])
    columns = columns[:, 1:] if numbered else columns
    if columns.shape[1] == 1:
        return columns.T, None, ()
    return _placed(*columns.T) if columns.shape[1] == 2 else None


def in_one_row(values):
    """Heights of one row or one column, or without columns, as one row (1, points); others unchanged."""
    return values.reshape(1, -1) if values.ndim == 1 or values.ndim == 2 and values.shape[1] == 1 else values


def _placed(x, z):
    """Profile of heights z at positions x; None if x neither rises nor falls."""
    if not np.isfinite(x).all() or x[0] == x[-1]:
        return None
    found, even = f"a column of coordinates ({x[0]:g} to {x[-1]:g})", np.linspace(x[0], x[-1], x.size)
    off = np.abs(x - even).max() / abs(even[1] - even[0])
    if off <= EVEN or coordinates.is_even(x) or off <= 1 and not _rises(x * np.sign(x[-1] - x[0])):  # as they were rounded
        return z[None], coordinates.step(x), (found,)
    if not _rises(x * np.sign(x[-1] - x[0])):
        return None
    order = np.argsort(x)
    return np.interp(even, x[order], z[order])[None], coordinates.step(x), (found, UNEVEN)


def _rises(many):
    return bool(np.all(np.diff(many) > 0))  # nan does not


def _counts(many):
    return many[0] in (0, 1) and bool(np.all(np.diff(many) == 1))
