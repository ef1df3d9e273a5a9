"""Conversion of lists of points x, y, z to a grid of heights."""

import itertools
import math

import numpy as np

from tehl_taichi.scene.surface.maps import coordinates

ROUNDED = 1e-6  # of the range of coordinates: digits beyond are rounding
EVEN = 0.1  # of a step, more than in `coordinates`: few rounded coordinates that form a grid are no chance
WHOLE = 0.5  # of the points of a grid, at least, that are in the list
FEWEST = 4  # points along each axis


def grid_of(values, names=()):
    """Grid of a list of points (points, columns): (heights (rows along y, columns along x), distance along x, along y); nan
    where the list has no point. None without coordinates of a regular grid.

    Two columns are coordinates, x first; the first other column holds the heights, unless the names of the columns (x, y, z)
    say otherwise.
    """
    many = values if values.shape[0] >= values.shape[1] else values.T
    if len(names) == many.shape[1] and {"x", "y", "z"} <= set(names):
        many = many[:, [names.index(name) for name in "xyz"]]
    axes = [_axis(column) for column in many.T]
    for first, second in itertools.combinations([n for n, axis in enumerate(axes) if axis is not None], 2):
        (xs, i), (ys, j) = axes[first], axes[second]
        places = j * xs.size + i
        if WHOLE * xs.size * ys.size <= len(many) <= xs.size * ys.size and np.unique(places).size == len(many):
            heights = np.full(xs.size * ys.size, math.nan)
            heights[places] = many[:, next(n for n in range(many.shape[1]) if n not in (first, second))]
            return heights.reshape(ys.size, xs.size), _step(xs), _step(ys)
    return None


def _axis(column):
    """(coordinates, index of each point) of a column with few, evenly spaced values; None for another column."""
    if not np.isfinite(column).all() or np.ptp(column) == 0:
        return None
    scale = ROUNDED * float(np.ptp(column))
    _, first, index = np.unique(np.round((column - column.min()) / scale), return_index=True, return_inverse=True)
    many = column[first]
    if not FEWEST <= many.size <= len(column) / 2:
        return None
    steps = np.diff(many)
    even = np.abs(steps - steps.mean()).max() <= EVEN * steps.mean() or coordinates.is_even(many)
    return (many, index.ravel()) if even else None


def _step(many):
    return float(many[-1] - many[0]) / (many.size - 1)
