"""Interpolation from the nodes of a grid to those of a finer one: matrices of Lagrange weights, one along each axis."""

import functools

import numpy as np

from tehl_taichi.values.interpolation import lagrange


@functools.lru_cache(maxsize=32)
def matrix(factor, nodes, points, mirrored=False, odd=False):
    """Weights (fine nodes, nodes) of the nodes 0 ... nodes - 1 for all fine nodes, `factor` of them per cell.

    points: of the polynomial. Near the ends it is one-sided; with `mirrored` node 0 is a symmetry axis, with `odd` an
    antisymmetric one.
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
    """Interpolation of fields (..., rows, columns) to a window of fine nodes: first row and column, their numbers. Nodes beyond
    an end of the grid take the value there.
    """

    def __init__(self, first, count, factor, nodes, mirrored):
        self.parts = [np.clip(np.arange(begin, begin + number), 0, (of - 1) * factor)
                      for begin, number, of in zip(first, count, nodes)]
        self.factor, self.nodes, self.mirrored = factor, nodes, mirrored

    def smooth(self, field, points=6):
        """Field by polynomials through `points` nodes, in its own precision."""
        (rows, y), (columns, x) = (_needed(matrix(self.factor, nodes, points, mirrored)[part])
                                   for nodes, part, mirrored in zip(self.nodes, self.parts, (self.mirrored, False)))
        own = np.result_type(field, np.float32)
        return y.astype(own, copy=False) @ field[..., rows, columns] @ x.T.astype(own, copy=False)

    def pressure(self, field):
        """Pressure by cubic polynomials, linear in cells with a dry node, never negative."""
        dry = self.smooth((field <= 0.0).astype(float), 2) > 0.0
        return np.maximum(np.where(dry, self.smooth(field, 2), self.smooth(field, 4)), 0.0)


def _needed(weights):
    """(slice of the nodes that these weights (fine nodes, nodes) use, weights of them)."""
    used = np.flatnonzero(weights.any(axis=0))
    nodes = slice(used[0], used[-1] + 1)
    return nodes, weights[:, nodes]
