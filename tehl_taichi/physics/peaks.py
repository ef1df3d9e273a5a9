"""Peaks of a field on its grid; arrays."""

import numpy as np

CELLS, PART = 2, 0.5  # a peak that falls to under this part within so many cells has no size that the grid could tell


def peak(field):
    """Index of the largest value."""
    return np.unravel_index(int(np.argmax(field)), np.shape(field))


def unresolved_peak(field):
    """Whether the largest value of `field` (a pressure, nodes along x and y in either order) lies within two cells of a fall
    to under half of it.

    The front of a frozen film that ends in a free edge is such a peak: it grows like the inverse square root of the cell, and
    so does any number that depends on it. Nodes beyond the border count as equal.
    """
    field = np.asarray(field)
    top = peak(field)
    return any(_beside(field, top, axis).min() < PART * field[top] for axis in range(field.ndim))


def _beside(field, top, axis):
    """Values at most CELLS away along `axis`."""
    line = field[(*top[:axis], slice(None), *top[axis + 1 :])]
    return line[max(top[axis] - CELLS, 0) : top[axis] + CELLS + 1]
