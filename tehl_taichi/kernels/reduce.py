"""Reductions and vector updates that give the same bits on any number of threads: fixed blocks, serial last sum."""

import taichi as ti

from tehl_taichi.kernels.reynolds import Flat, Table

BLOCK = 512  # entries per partial sum; fixed, whatever the number of threads


@ti.kernel
def block_dots(V: Table, count: ti.i32, w: Flat, n: ti.i32, partial: Table):
    """partial[b, m] = sum over block b of V[m] w, m < count."""
    for b in range((n + BLOCK - 1) // BLOCK):
        first, last = b * BLOCK, ti.min((b + 1) * BLOCK, n)
        for m in range(count):
            s = 0.0
            for q in range(first, last):
                s += V[m, q] * w[q]
            partial[b, m] = s


@ti.kernel
def subtract(V: Table, count: ti.i32, h: Flat, w: Flat, n: ti.i32):
    """w -= sum_m h[m] V[m]."""
    for b in range((n + BLOCK - 1) // BLOCK):
        first, last = b * BLOCK, ti.min((b + 1) * BLOCK, n)
        for m in range(count):
            for q in range(first, last):
                w[q] -= h[m] * V[m, q]


@ti.kernel
def combine(Z: Table, count: ti.i32, y: Flat, x: Flat, n: ti.i32):
    """x = sum_m y[m] Z[m]."""
    for b in range((n + BLOCK - 1) // BLOCK):
        first, last = b * BLOCK, ti.min((b + 1) * BLOCK, n)
        for q in range(first, last):
            x[q] = 0.0
        for m in range(count):
            for q in range(first, last):
                x[q] += y[m] * Z[m, q]
