"""Peaks of the index on a surface, apart from each other. On a rough surface the critical point alone does not show whether
another asperity is harmless."""

import numpy as np


def worst_places(x, y, index, apart, most):
    """[(i, j)] of at most so many peaks of index (x, y), the largest first, none nearer than `apart` (as x and y) to a larger
    one; x: (nx,), y: (ny,)."""
    left, found = np.where(_peaks(index), index, -np.inf), []
    while len(found) < most and np.isfinite(left).any():
        i, j = np.unravel_index(int(np.argmax(left)), left.shape)
        found.append((int(i), int(j)))
        left[np.hypot((x - x[i])[:, None], y - y[j]) < apart] = -np.inf
    return found


def around(x, y, values, place, within):
    """The largest of values (x, y) within so far of a place."""
    i, j = place
    return float(values[np.hypot((x - x[i])[:, None], y - y[j]) <= within].max())


def _peaks(index):
    """Points without a larger neighbour; neighbours beyond the edge do not count."""
    wide = np.pad(index, 1, constant_values=-np.inf)
    nx, ny = index.shape
    return np.all([index >= wide[i : i + nx, j : j + ny] for i in range(3) for j in range(3)], axis=0)
