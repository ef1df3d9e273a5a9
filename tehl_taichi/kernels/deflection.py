"""What surrounds the transforms of the deflection: packing, adding the line part."""

import taichi as ti

from tehl_taichi.kernels.fields import GAP0, H
from tehl_taichi.kernels.reynolds import Flat, Table, cells


@ti.kernel
def pack(V: Table, n: ti.i32, nx: ti.i32, ny: ti.i32, line: ti.i32, padded: Table, edge: Flat):
    """padded[j, i] = V[n] (minus its outermost row when `line`, which goes to `edge` and continues to infinity)."""
    for j in range(ny + 1):
        for i in range(nx + 1):
            e = V[n, ny * (nx + 1) + i] * line
            padded[j, i] = V[n, j * (nx + 1) + i] - e
            if j == ny:
                edge[i] = e


@ti.kernel
def unpack(padded: Table, edge: Flat, nx: ti.i32, ny: ti.i32, W: Table):
    """W[0] = deflection + line part (which carries the rigid approach too)."""
    for j in range(ny + 1):
        for i in range(nx + 1):
            W[0, j * (nx + 1) + i] = padded[j, i] + edge[i]


@ti.kernel
def add_gap(S: Table, G: Table, W: Table):
    """H = undeformed gap + W on the finest level."""
    nx, ny, off = cells(G, 0)
    for j in range(ny + 1):
        for q in range(j * (nx + 1), (j + 1) * (nx + 1)):
            S[H, q] = S[GAP0, q] + W[0, q]
