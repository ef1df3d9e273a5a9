"""Film under the pressure in the table: the deflection in double precision, on the card."""

import numpy as np

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import V, W
from tehl_taichi.pressure.fields import GAP0, H, P
from tehl_taichi.pressure.linear import convolution
from tehl_taichi.pressure.linear.cells.convolution import Convolutions, column, convolve, put_pair
from tehl_taichi.pressure.linear.cells.sizes import place


@ti.func
def bends(S: ti.template(), c: ti.template(), s, k):
    """Pressure of column k that bends the bodies: without the sides of a point contact, see
    :mod:`tehl_taichi.pressure.deflection`."""
    out = S[P, k]
    if ti.static(not c.endless):
        for u in ti.static(range(W)):
            if s * W + u >= c.ny or (s * W + u == 0 and c.half_first < 0):
                out[u] = 0.0
    return out


@ti.kernel
def bend(F: ti.template(), H0: ti.f64):
    """Set H of the finest level: undeformed gap + deflection by P + H0."""
    c = ti.static(F.convolution)
    for t in range(F.K.columns.total):
        s, m = t // c[0].M, t % c[0].M
        k, even, odd = c[0].level.first + s * c[0].level.n2 + 2 * m, V(0.0), V(0.0)
        if 2 * m < c[0].level.n2:
            even = bends(F.S, c[0], s, k)
        if 2 * m + 1 < c[0].level.n2:
            odd = bends(F.S, c[0], s, k + 1)
        put_pair(F.K, c[0], s, m, even, odd)
    convolve(F.K)
    for q in range(c[0].level.columns):
        s, i = place(c[0].level, q)
        k = c[0].level.first + q
        F.S[H, k] = F.S[GAP0, k] + (column(F.K, c[0], s, i) + H0)


class BendingFields:
    """Fields that :func:`bend` uses; K: the Convolutions of the deflection."""

    def __init__(self, levels, K):
        self.S, self.K, self.convolution = levels.S, K, K.all


class CellBending:
    """Computes the film of a :class:`tehl_taichi.pressure.levels.Levels`."""

    def __init__(self, levels):
        shape = convolution.transform_sizes([(levels.nx, levels.ny)], [])[0]
        K = Convolutions(levels, [convolution.deflection(shape, levels)], "f64", np.dtype(float))
        self.memory = BendingFields(levels, K)

    def bend(self, H0):
        """Set H from the pressure in the table and the rigid approach H0."""
        bend(self.memory, H0)
