"""Indices and conversions that all jobs of a linear solve use."""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import cells
from tehl_taichi.pressure.fields import TRIAL
from tehl_taichi.pressure.linear.convolution import side_by_side


@ti.func
def block(G: ti.template(), s):
    """(first column, end, offset) of block s of the finest level: its columns among the vectors of V are first to end - 1; in
    the tables they are shifted by offset."""
    nx, ny, off = cells(G, 0)
    return s * (nx + 1), (s + 1) * (nx + 1), off


@ti.func
def number(F: ti.template(), x):
    """x in the precision of the solver."""
    return ti.cast(x, F.J.dtype)


@ti.func
def take(F: ti.template(), k, k2, row, y, z):
    """Set the pressure changes y, z of the columns k, k2 as a direction (TRIAL), and write them to `row` of Y for the
    transform."""
    F.J[TRIAL, k2], F.J[TRIAL, k], F.Y[0, row] = z, y, side_by_side(y, z)
