"""Separate peaks of the index on a surface. On a rough surface the critical point alone does not show whether another asperity
is harmless.
"""

import numpy as np


def worst_places(x, y, index, apart, most):
    """[(i, j)] of at most `most` peaks of index (x, y), the largest first, each at least `apart` (in the unit of x and y) from
    a larger one; x: (nx,), y: (ny,).
    """
    left, found = np.where(_peaks(index), index, -np.inf), []
    while len(found) < most and np.isfinite(left).any():
        i, j = np.unravel_index(int(np.argmax(left)), left.shape)
        found.append((int(i), int(j)))
        left[np.hypot((x - x[i])[:, None], y - y[j]) < apart] = -np.inf
    return found


def around(x, y, values, place, within):
    """Largest of values (x, y) within a distance of a place."""
    i, j = place
    return float(values[np.hypot((x - x[i])[:, None], y - y[j]) <= within].max())


def _peaks(index):
    """Mask of points without a larger neighbour, including those at the edge."""
    wide = np.pad(index, 1, constant_values=-np.inf)
    nx, ny = index.shape
    return np.all([index >= wide[i : i + nx, j : j + ny] for i in range(3) for j in range(3)], axis=0)
