"""Past states as rows of a table of the finest grid, and their displacement along x."""

import functools
import math

import numpy as np

from tehl_taichi.engine import field_pool, simd
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import L
from tehl_taichi.engine.taichi_patches.prebound import Carriers
from tehl_taichi.values.interpolation import lagrange

REACH = 6  # nodes of an interpolation along x
BACK, BEGIN, END = range(REACH, REACH + 3)  # columns of a way behind its weights: where its first node is, which nodes count
WAY = REACH + 3
WHOLE = 1e-9  # cells


def shift(cells):
    """(back, weights) of a field moved by `cells` towards +x: node i gets the sum of weights[k] times the value at i - back +
    k. Whole cells have a single weight, 1.
    """
    whole = math.floor(cells + WHOLE)
    part = cells - whole
    return whole + 3, _weights(0.0 if part < WHOLE else part)


@functools.lru_cache(maxsize=16)
def _weights(part):
    """Weights of the nodes -3 ... 2 for the value at -part."""
    return lagrange(range(-3, 3), -part)


def carried(q, cells):
    """Field q (..., nx+1) moved by `cells` towards +x, outside of kernels; inflow has the border values."""
    back, weights = shift(cells)
    if 1.0 in weights:
        return _by_columns(q, back - 3)
    at, last = np.arange(q.shape[-1]), q.shape[-1] - 1
    return sum(weight * np.take(q, np.clip(at - back + k, 0, last), -1) for k, weight in enumerate(weights) if weight)


def _by_columns(q, cells):
    """Field q moved by whole cells."""
    columns = min(abs(cells), q.shape[-1] - 1)
    if not columns:
        return q
    kept, border = (q[..., :-columns], q[..., :1]) if cells > 0 else (q[..., columns:], q[..., -1:])
    inflow = np.repeat(border, columns, axis=-1)
    return np.concatenate([inflow, kept] if cells > 0 else [kept, inflow], axis=-1)


def set_way(way, cells, weight=1.0):
    """Set a row (WAY) of the table of displacements for kernels: :func:`shift` by `cells`, times a weight."""
    way[BACK], weights = shift(cells)
    way[:REACH] = np.multiply(weights, weight)
    way[BEGIN:] = (3, 4) if 1.0 in weights else (0, REACH)


@ti.func
def nodes(ways: ti.template(), way):
    """(first node, end) of an interpolation; one node if features move by whole cells."""
    return int(ways[way, BEGIN]), int(ways[way, END])


@ti.func
def source(i, nx, ways: ti.template(), way, m):
    """Column of node m of an interpolation; inflow has the border values."""
    return ti.min(ti.max(i - int(ways[way, BACK]) + m, 0), nx)


@ti.func
def moved(F: ti.template(), row, first, i, nx, ways: ti.template(), way, each, n):
    """Number n of `each` in column i of a block with first column `first`, moved by displacement number `way`."""
    out = L(F, 0.0)
    begin, end = nodes(ways, way)
    for m in range(begin, end):
        out += ti.cast(ways[way, m], F.dtype) * F[row, (first + source(i, nx, ways, way, m)) * each + n]
    return out


class StateHistory:
    """Table of some rows on the finest grid of `levels`, column s (NX + 1) + i; not cleared."""

    def __init__(self, levels, rows, precision="f64"):
        self.levels, self.carriers = levels, Carriers()
        self.field = field_pool.lease(self, rows, simd.W, levels.most_columns, precision=precision, clean=False)
        self.place = levels.G[:1].copy()
        self.place[0, simd.OFF] = 0

    def get(self, row):
        """Row as a new array (ny+1, nx+1)."""
        return self._carry(simd.get, row, (self.levels.nx + 1, self.levels.ny + 1)).copy().T

    def put(self, row, values):
        """Set a row from an array that broadcasts to (ny+1, nx+1)."""
        self._carry(simd.put, row, (self.levels.ny + 1, self.levels.nx + 1), values)

    def _carry(self, kernel, row, shape, values=None):
        return self.carriers.carry((kernel, row), shape,
                                   lambda array: self.levels.launch(kernel, self.field, self.place, 0, row, array), values)
