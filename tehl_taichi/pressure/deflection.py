"""Elastic deflection of both surfaces by a pressure, and the pressure that gives a wanted film change."""

import functools

import numpy as np

from tehl_taichi.engine.fftw import pyfftw
from tehl_taichi.engine.transforms import EvenConvolution, PlainConvolution, block_rows, even_fast_length, wrapped
from tehl_taichi.pressure import influence


class Deflection:
    """W = K P on one grid: exact coefficients, zero padding. line: the outermost row continues for ever; mirrored: rows
    y < 0 are the mirror image of the others.

    The pressure must vanish in the first column, and in the first row of a grid that is not mirrored: an even period of
    twice the cells is exact then. It is written into `pressure`; the deflection is `film` + `edge`, rows (of whole blocks
    of lanes, `period` columns) plus one line for all rows.
    """

    def __init__(self, nx, ny, dx, dy, compliance, line, mirrored=True, dtype=float):
        self.nx, self.ny, self.line, self.mirrored, self.dtype = nx, ny, line, mirrored, dtype
        period = even_fast_length(2 * nx)
        self.pressure, self.film = block_rows(ny, period, dtype), block_rows(ny, period, dtype)
        self.edge = np.zeros(nx + 1, dtype)
        self.plane = self._plane(period, dx, dy, compliance) if ny else None
        self.strip = self._strip(period, dx) if line else None

    def _plane(self, period, dx, dy, compliance):
        rows = 2 * self.ny + 1 if self.mirrored else even_fast_length(2 * self.ny)
        kind = EvenConvolution if self.mirrored else PlainConvolution
        convolution = kind(self.pressure, self.film, self.ny, rows)
        convolution.set_symbol(_plane_symbol(self.nx, self.ny, dx, dy, compliance, kind, rows, period))
        return convolution

    def _strip(self, period, dx):
        source, result = (pyfftw.zeros_aligned((1, period), self.dtype) for _ in range(2))
        convolution = EvenConvolution(source, result, 0, 1)
        convolution.set_symbol(convolution.spectrum(wrapped(influence.strip(self.nx, dx)[None, :], period)))
        return convolution

    def deflect(self, add=0.0):
        """`film` + `edge` = deflection of `pressure`, which is overwritten, plus `add`."""
        self.edge[:] = add
        if self.line:
            last = self.strip.source[0]
            last[:] = self.pressure[self.ny]
            self.strip.convolve()
            self.edge += self.strip.result[0, : self.nx + 1]
            self.pressure -= last
        if self.plane:
            self.plane.convolve()
        else:
            self.film[:] = 0.0

    def apply(self, P):
        """Deflection (ny+1, nx+1) of the pressure P of the same shape."""
        self.pressure[: self.ny + 1, : self.nx + 1] = P
        self.deflect()
        return self.film[: self.ny + 1, : self.nx + 1] + self.edge


@functools.lru_cache(maxsize=2)  # a grid has one transform in single and one in double precision
def _plane_symbol(nx, ny, dx, dy, compliance, kind, rows, period):
    """Symbol of the deflection by cells for a convolution of this kind."""
    coefficients = influence.rectangle(nx, 2 * ny, dx, dy, compliance).T
    if kind is PlainConvolution:
        coefficients = wrapped(coefficients[: ny + 1].T, rows).T
    return kind.spectrum(wrapped(coefficients, period))
