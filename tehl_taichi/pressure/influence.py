"""Exact influence coefficients of the normal deflection for cell-constant pressure, dimensionless (Hertz units).

Film change W = C int P / r dX dY with the compliance C of the scales (1/(2 pi) for a line, 2/pi^2 for a circular contact); for
the y-invariant part of a line contact W = -(1/pi) int P ln|X - X'| dX' (Johnson, Contact Mechanics, sections 2.2 and 3.2).
"""

import functools

import numpy as np


def rectangle(nx, ny, dx, dy, compliance):
    """Deflection at offsets (i dx, j dy) of a unit pressure on the cell at the origin; shape (nx + 1, ny + 1)."""
    x, y = (np.arange(nx + 2) - 0.5)[:, None] * dx, (np.arange(ny + 2) - 0.5)[None, :] * dy  # edges of cells
    return compliance * np.diff(np.diff(_primitive(x, y), axis=0), axis=1)


def _primitive(x, y):
    return y * np.arcsinh(x / np.abs(y)) + x * np.arcsinh(y / np.abs(x))


def strip(nx, dx):
    """Deflection at offsets i dx of a unit pressure on a strip of width dx, infinite in y; shape (nx + 1,)."""
    edges = (np.arange(nx + 2) - 0.5) * dx
    integral = edges * np.log(np.abs(edges)) - edges
    return -np.diff(integral) / np.pi


@functools.lru_cache(maxsize=4)  # the grids of a steady start end in the same one
def matrix(nx, ny, dx, dy, compliance, line, mirrored=True):
    """Deflection of a small grid as a matrix (nodes, nodes), rows along x.

    line: the pressure of the last row continues beyond it (of a whole grid, the mean of both outermost rows); mirrored: rows
    y < 0 mirror the others. The first column of the grid has no pressure.
    """
    i, j = np.arange(nx + 1), np.arange(ny + 1)
    along = np.abs(i[:, None] - i)
    K = np.zeros((ny + 1, nx + 1, ny + 1, nx + 1))
    if ny:
        cells = rectangle(nx, 2 * ny, dx, dy, compliance)
        K += cells[along[None, :, None, :], np.abs(j[:, None] - j)[:, None, :, None]]
        if mirrored:
            K[:, :, 1:] += cells[along[None, :, None, :], (j[:, None] + j[1:])[:, None, :, None]]
    if line:  # the pressure beyond is a strip without end, the rows differ from it
        rest = strip(nx, dx)[along] - K.sum(axis=2)
        for row in [-1] if mirrored else [0, -1]:
            K[:, :, row] += rest if mirrored else rest / 2
    K[..., 0] = 0.0
    return K.reshape((ny + 1) * (nx + 1), -1)


@functools.lru_cache(maxsize=16)  # levels of the same size belong to several grids of a start
def symbol(nx_period, ny, dx, dy, compliance, aliases=2):
    """Fourier symbol of the deflection of a periodic row of cells: shape (ny + 1, nx_period // 2 + 1).

    Cosine modes of period 2 ny in y (ny = 0: one-dimensional), full aliasing sum of 2 pi C sinc sinc / |k|. The mean has no
    finite value; it is set to twice the lowest mode along x.
    """
    kx = 2 * np.pi * np.arange(nx_period // 2 + 1) / (nx_period * dx)
    ky = np.pi * np.arange(ny + 1) / (max(ny, 1) * dy)
    total = np.zeros((ny + 1, kx.size))
    for p in range(-aliases, aliases + 1):
        for q in range(-aliases, aliases + 1) if ny else [0]:
            total += _mode(kx + 2 * np.pi * p / dx, ky + 2 * np.pi * q / dy, dx, dy if ny else 0.0)
    total *= 2 * np.pi * compliance
    total[0, 0] = 2 * total[0, 1]
    return total


def _mode(kx, ky, dx, dy):
    k = np.sqrt(kx[None, :] ** 2 + ky[:, None] ** 2)
    k[k == 0] = 1.0
    return np.sinc(kx * dx / 2 / np.pi)[None, :] * np.sinc(ky * dy / 2 / np.pi)[:, None] / k
