"""Chebyshev-Lobatto nodes across the film, and the polynomials through values at them."""

import functools

import numpy as np
from numpy.polynomial import chebyshev as series

NEAR = 0.05  # of the rise: between nodes a profile is higher than at them by far less
FINE = 33  # places that show which profile is the highest; its own maximum is exact

# rows of the table of nodes, and the matrices (a row per node each) that follow them
ZETA, WEIGHT, MATRICES = range(3)
INTEGRAL, SLOPE, SECOND, BEYOND = range(4)


class ChebyshevNodes:
    """`count` nodes across a film. zeta (n,): positions on [0, 1]; C (n, n): integrals from 0 to each node; D1 and D2 (n, n):
    first and second derivatives; weights (n,): of the integral over the whole film; table: all of them for kernels.
    """

    def __init__(self, count):
        self.zeta, self.C, self.D1, self.D2 = chebyshev(count)
        self.weights = self.C[-1]
        self.table = np.zeros((MATRICES + 4 * count, count))
        self.table[ZETA], self.table[WEIGHT] = self.zeta, self.weights
        # beyond node m: sum_n w[n] C[n, m] f[n], the integral over zeta of what lies below each place, turned round
        matrices = {INTEGRAL: self.C, SLOPE: self.D1, SECOND: self.D2, BEYOND: self.weights[:, None] * self.C}
        for place, matrix in matrices.items():
            first = MATRICES + place * count
            self.table[first : first + count] = matrix


def chebyshev(count):
    """(nodes on [0, 1], integrals from 0 to each node (n, n), first and second derivative matrices) of Chebyshev-Lobatto
    collocation with `count` nodes."""
    x = -np.cos(np.pi * np.arange(count) / (count - 1))
    sign = (-1.0) ** np.arange(count) * np.where((np.arange(count) % (count - 1)) == 0, 2.0, 1.0)
    distance = x[:, None] - x[None, :] + np.eye(count)
    D = np.outer(sign, 1 / sign) / distance
    D -= np.diag(D.sum(axis=1))
    integral = np.stack([series.chebval(x, series.chebint(row, lbnd=-1)) for row in np.eye(count)], axis=1)
    C = 0.5 * integral @ np.linalg.inv(series.chebvander(x, count - 1))
    return 0.5 * (x + 1), C, 2 * D, 4 * D @ D


def largest(T):
    """Largest value of the polynomials through T (nz, ...).

    The hottest place of a film is between nodes; the largest value at 9 nodes is up to 2 K lower than at 17.
    """
    columns = np.asarray(T).reshape(len(T), -1)
    top = columns.max(axis=0)
    near = columns[:, top >= top.max() - NEAR * (top.max() - columns.min())]
    series_of, between = _interpolation(len(T))
    return _maximum(series_of @ near[:, (between @ near).max(axis=0).argmax()])


def _maximum(coefficients):
    """Maximum of one Chebyshev series on [-1, 1]: at an end, or where its slope is 0."""
    slope = np.trim_zeros(series.chebder(coefficients), "b")
    turns = series.chebroots(slope) if slope.size > 1 else np.zeros(0)
    inside = turns.real[np.abs(turns.imag) < 1e-6]
    return float(series.chebval(np.clip([-1.0, 1.0, *inside], -1.0, 1.0), coefficients).max())


@functools.lru_cache(maxsize=8)
def _interpolation(count):
    """Matrices from the values at `count` nodes to the Chebyshev series through them, and to values at FINE places."""
    series_of = np.linalg.inv(_values(count, count))
    return series_of, _values(FINE, count) @ series_of


def _values(places, count):
    """Values of the first `count` Chebyshev polynomials at `places` Lobatto nodes."""
    return series.chebvander(-np.cos(np.pi * np.arange(places) / (places - 1)), count - 1)
