"""Places and numbers that all jobs of a linear solve use."""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import cells
from tehl_taichi.pressure.fields import TRIAL
from tehl_taichi.pressure.linear.convolution import side_by_side


@ti.func
def block(G: ti.template(), s):
    """Columns of block s of the finest level: first and behind the last, in vectors; what the tables have in front."""
    nx, ny, off = cells(G, 0)
    return s * (nx + 1), (s + 1) * (nx + 1), off


@ti.func
def number(F: ti.template(), x):
    return ti.cast(x, F.J.dtype)


@ti.func
def take(F: ti.template(), k, k2, row, y, z):
    """Changes of the pressure of columns k and k2 as a direction, and to be transformed."""
    F.J[TRIAL, k2], F.J[TRIAL, k], F.Y[0, row] = z, y, side_by_side(y, z)
