"""From the nodes of a grid to those of a finer one: matrices of Lagrange weights, one along each axis."""

import functools

import numpy as np

from tehl_taichi.values.interpolation import lagrange


@functools.lru_cache(maxsize=32)
def matrix(factor, nodes, points, mirrored=False, odd=False):
    """Weights (fine nodes, nodes) of the nodes 0 ... nodes - 1 for all fine ones, `factor` of them to a cell.

    points: of the polynomial; near the ends it is one-sided, but mirrored about node 0 where `mirrored`, with the other sign
    there where the field is `odd`.
    """
    out = np.zeros(((nodes - 1) * factor + 1, nodes))
    for fine, row in enumerate(out):
        cell, part = divmod(fine, factor)
        if part == 0:
            row[cell] = 1.0
            continue
        begin = cell - points // 2 + 1
        begin = min(begin if mirrored else max(begin, 0), nodes - points)
        for node, weight in zip(range(begin, begin + points), lagrange(range(begin, begin + points), cell + part / factor)):
            row[abs(node)] += -weight if odd and node < 0 else weight
    return out


class Refining:
    """Fields (..., rows, columns) of a grid at the nodes of a window of fine ones: first and number of rows and of columns.
    Those beyond an end of the grid count as that."""

    def __init__(self, first, count, factor, nodes, mirrored):
        self.parts = [np.clip(np.arange(begin, begin + number), 0, (of - 1) * factor)
                      for begin, number, of in zip(first, count, nodes)]
        self.factor, self.nodes, self.mirrored = factor, nodes, mirrored

    def smooth(self, field, points=6):
        """By polynomials through so many nodes."""
        y, x = (matrix(self.factor, nodes, points, mirrored)[part] if nodes > 1 else np.ones((1, 1))
                for nodes, part, mirrored in zip(self.nodes, self.parts, (self.mirrored, False)))
        return y @ field @ x.T

    def pressure(self, field):
        """By cubic polynomials, linear in cells with a dry node, never negative."""
        dry = self.smooth((field <= 0.0).astype(float), 2) > 0.0
        return np.maximum(np.where(dry, self.smooth(field, 2), self.smooth(field, 4)), 0.0)
