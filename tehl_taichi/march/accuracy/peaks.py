"""Peaks and ripples of a pressure on its grid; arrays with nodes along x first."""

import numpy as np

NARROW = 0.75  # a largest pressure of which less is left two cells away, on the mean of both sides, is not resolved
# A lower peak grows on finer grids by up to this part of what it loses in two cells: on grids four times as fine 0.86 of the
# largest with 0.59 of it left there became 1.06, 0.92 with 0.60 1.08, 0.99 with 0.81 1.01; 0.76 with 0.69 stayed
GROWS, SHARP = 0.5, 0.85
LEAST = 1 / (1 + GROWS)  # of the largest pressure: no lower peak leaves it unknown
WAVE = 8  # nodes of a ripple


def peak(field):
    """Index of the largest value."""
    return np.unravel_index(int(np.argmax(field)), np.shape(field))


def sharpest(p, largest=None):
    """(height over the largest, place (i, j)) of the highest peak along x of a pressure (nx+1, ny+1) that makes the largest
    pressure unknown; height 0 without one.

    It is the largest peak itself if it is narrow, or a lower one, on any row, so sharp that it may exceed it on finer grids:
    beside the axis of a circle a thin ridge does. The front of a frozen film that ends in a free edge is such a peak: it grows
    with the inverse square root of the cell, as does any number that depends on it. largest: over more moments than this one;
    lower peaks then count only if they are narrow (otherwise the largest peak a moment ago would be its own rival).
    """
    sharp, largest = (SHARP, p.max()) if largest is None else (NARROW, largest)
    i, j = np.nonzero(_tops(p) & (p[2:-2] >= LEAST * largest))
    i += 2
    height, left = p[i, j] / largest, 0.5 * (p[i - 2, j] + p[i + 2, j]) / p[i, j]
    unknown = np.where(height >= 1.0, left < NARROW, (left < sharp) & (height * (1 + GROWS * (1 - left)) > 1))
    found = max(zip(height[unknown].tolist(), i[unknown].tolist(), (-j[unknown]).tolist()), default=(0.0, 0, 0))
    return found[0], (found[1], -found[2])


def _tops(p):
    """Whether a pressure has a peak along x, no lower than the rows beside it; of all but the two nodes at each end."""
    beside = np.pad(p[2:-2], ((0, 0), (1, 1)), mode="edge")
    tops = (p[2:-2] > p[1:-3]) & (p[2:-2] >= p[3:-1])
    return tops & (p[2:-2] >= np.maximum(beside[:, :-2], beside[:, 2:]))


def ripple(field):
    """(amplitude, first node) of the largest alternation from node to node along the first axis over at least WAVE nodes.

    A sixteenth of the fourth difference is the amplitude of such a wave. For a smooth field it is far smaller, and for a kink
    or a spike it changes sign within WAVE nodes.
    """
    p = np.asarray(field, float)
    if len(p) < WAVE + 4:
        return 0.0, 0
    wave = (p[:-4] - 4 * p[1:-3] + 6 * p[2:-2] - 4 * p[3:-1] + p[4:]) / 16
    wave[1::2] *= -1
    least, most = wave, wave
    for step in (1, 2, 4):  # of WAVE neighbours
        least, most = np.minimum(least[:-step], least[step:]), np.maximum(most[:-step], most[step:])
    lasting = np.maximum(np.maximum(least, -most), 0.0)
    at = peak(lasting)
    return float(lasting[at]), int(at[0]) + 2
