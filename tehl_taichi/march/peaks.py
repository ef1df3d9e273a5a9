"""Peaks and ripples of a field on its grid; arrays."""

import numpy as np

CELLS, PART = 2, 0.5  # a peak that falls to under this part within so many cells has no size that the grid could tell
WAVE = 8  # nodes of a ripple


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


def ripple(field):
    """Largest amplitude of an alternation from node to node along the first axis that lasts for WAVE nodes.

    A sixteenth of the fourth difference is the amplitude of such a wave; that of a smooth field is far smaller, and that of a
    kink or a spike changes its sign within WAVE nodes.
    """
    p = np.asarray(field, float)
    if len(p) < WAVE + 4:
        return 0.0
    fourth = (p[:-4] - 4 * p[1:-3] + 6 * p[2:-2] - 4 * p[3:-1] + p[4:]) / 16
    wave = np.lib.stride_tricks.sliding_window_view(fourth * (-1.0) ** np.arange(len(fourth)).reshape(-1, *[1] * (p.ndim - 1)),
                                                    WAVE, axis=0)
    return float(np.maximum(wave.min(axis=-1), -wave.max(axis=-1)).max(initial=0.0))
