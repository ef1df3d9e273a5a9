"""FFT operators on pyfftw's own buffers, which the kernels read and write directly (no copies).

Plans are estimated and single-threaded: the same sums in the same order on every run and any number of threads. (FFTW's
own threads halve a lone transform, but between kernel launches they have gone to sleep: 0.58 -> 1.97 ms a distribution.)
"""

import numpy as np
import pyfftw

from tehl_taichi.kernels.lanes import W
from tehl_taichi.solvers import influence

PLAN = dict(flags=("FFTW_ESTIMATE",), threads=1)
MATRIX_ROWS = 257  # modes up to which the cosine transform is a matrix product (equal times at 257)


def even_fast_length(n):
    """Smallest even length >= n that FFTW likes (odd ones are slow)."""
    length = pyfftw.next_fast_len(n)
    while length % 2:
        length = pyfftw.next_fast_len(length + 1)
    return length


def _real(*shape):
    return pyfftw.zeros_aligned(shape, dtype="float64")


def _lane_rows(nx, ny, period):
    """Zero array (ny+1, period) and its first nx+1 columns as blocks of lanes (blocks, nx+1, W)."""
    blocks = ny // W + 1
    whole = _real(blocks * W, period)
    return whole[: ny + 1], whole.reshape(blocks, W, period)[:, :, : nx + 1].transpose(0, 2, 1)


def _complex(*shape):
    return pyfftw.zeros_aligned(shape, dtype="complex128")


class EvenConvolution:
    """Real transform along x (length `period`), cosine transform along y (`rows` modes, even about both ends).

    `source` (ny+1, period) -> `result` (same shape), multiplied by the symbol (rows, period//2+1) in between. Columns of
    `source` beyond the nx+1 of the grid stay zero. `source_blocks` and `result_blocks` are views (blocks, nx+1, W) of
    their first nx+1 columns in the order of the state table.
    """

    def __init__(self, nx, ny, rows, period):
        self.rows, self.half = rows, period // 2 + 1
        self.source, self.source_blocks = _lane_rows(nx, ny, period)
        self.result, self.result_blocks = _lane_rows(nx, ny, period)
        first, last = _complex(ny + 1, self.half), _complex(ny + 1, self.half)
        self.forward = pyfftw.FFTW(self.source, first, axes=(1,), **PLAN)
        self.back = pyfftw.FFTW(last, self.result, axes=(1,), direction="FFTW_BACKWARD", **PLAN)
        self.first, self.last = first.view("float64"), last.view("float64")
        self.cosine = Cosine(ny, rows, 2 * self.half)
        self.scale = 1 / (period * (2 * (rows - 1) if rows > 1 else 1))

    def set_kernel(self, values):
        """Symbol from the even kernel values (rows, period) laid out for this transform."""
        spectrum = np.fft.rfft(values, axis=1).real
        if self.rows > 1:
            spectrum = np.fft.rfft(np.vstack([spectrum, spectrum[-2:0:-1]]), axis=0).real
        self.set_symbol(spectrum)

    def set_symbol(self, symbol):
        """Real symbol (rows, period//2+1), stored twice: for the real and the imaginary parts."""
        self.symbol = np.repeat(symbol * self.scale, 2, axis=1)

    def run(self):
        """result = symbol * source."""
        self.forward.execute()
        spectrum = self.cosine.forward(self.first)
        np.multiply(spectrum, self.symbol, out=spectrum)
        self.cosine.back(spectrum, self.last)
        self.back.execute()


class Cosine:
    """Cosine transform (type I) along the rows: ny+1 given rows (zeros beyond) <-> `rows` modes.

    As a matrix product up to MATRIX_ROWS modes: it uses the zero rows and wins there (129 modes, 542 columns: 0.20 ms
    against 0.63 ms for FFTW's REDFT00); as FFTW's transform beyond.
    """

    def __init__(self, ny, rows, columns):
        self.ny, self.rows = ny, rows
        self.spectrum = _real(rows, columns)
        self.plain = rows <= MATRIX_ROWS
        if self.plain:
            self._matrices()
        else:
            self.padded = _real(rows, columns)
            plan = dict(axes=(0,), direction="FFTW_REDFT00", **PLAN)
            self.there = pyfftw.FFTW(self.padded, self.spectrum, **plan)
            self.again = pyfftw.FFTW(self.spectrum, self.padded, **plan)

    def _matrices(self):
        j = np.arange(self.rows)
        weight = np.full(self.rows, 2.0)
        weight[[0, -1]] = 1.0
        full = np.cos(np.pi * (np.outer(j, j) % (2 * max(self.rows - 1, 1))) / max(self.rows - 1, 1)) * weight
        self.to_modes = np.ascontiguousarray(full[:, : self.ny + 1])
        self.to_rows = np.ascontiguousarray(full[: self.ny + 1])

    def forward(self, values):
        """Modes (rows, columns) of values (ny+1, columns); an own buffer."""
        if self.plain:
            return np.matmul(self.to_modes, values, out=self.spectrum)
        self.padded[: self.ny + 1], self.padded[self.ny + 1 :] = values, 0.0
        self.there.execute()
        return self.spectrum

    def back(self, spectrum, values):
        """Rows 0..ny of the modes into `values` (unnormalised)."""
        if self.plain:
            np.matmul(self.to_rows, spectrum, out=values)
        else:
            self.again.execute()
            values[:] = self.padded[: self.ny + 1]


class PlainConvolution:
    """The same without a mirror: zero padding in both directions, a full transform along y (source, run, result alike)."""

    def __init__(self, nx, ny, rows, period):
        self.ny, self.half = ny, period // 2 + 1
        self.source, self.source_blocks = _lane_rows(nx, ny, period)
        self.result, self.result_blocks = _lane_rows(nx, ny, period)
        self.padded, last = _complex(rows, self.half), _complex(ny + 1, self.half)
        self.first, self.last = self.padded[: ny + 1], last
        self.forward = pyfftw.FFTW(self.source, self.first, axes=(1,), **PLAN)
        self.along = pyfftw.FFTW(self.padded, self.padded, axes=(0,), **PLAN)
        self.again = pyfftw.FFTW(self.padded, self.padded, axes=(0,), direction="FFTW_BACKWARD", **PLAN)
        self.back = pyfftw.FFTW(last, self.result, axes=(1,), direction="FFTW_BACKWARD", **PLAN)
        self.scale = 1 / (period * rows)

    def set_kernel(self, values):
        """Symbol from the even kernel values (rows, period) laid out for this transform."""
        self.symbol = np.fft.fft(np.fft.rfft(values, axis=1).real, axis=0).real * self.scale

    def run(self):
        """result = symbol * source."""
        self.padded[self.ny + 1 :] = 0.0
        self.forward.execute()
        self.along.execute()
        np.multiply(self.padded, self.symbol, out=self.padded)
        self.again.execute()
        self.last[:] = self.first
        self.back.execute()


class Deflection:
    """W = K P on one grid: exact coefficients, zero padding. line: the outermost row continues for ever; mirrored: rows
    y < 0 are the mirror image of the others."""

    def __init__(self, nx, ny, dx, dy, compliance, line, mirrored=True):
        self.nx, self.ny, self.line, self.mirrored = nx, ny, line, mirrored
        period = even_fast_length(2 * nx + 1)
        self.plane = self._plane(period, dx, dy, compliance) if ny else None
        self.strip = self._strip(period, dx) if line else None

    def _plane(self, period, dx, dy, compliance):
        coefficients = influence.rectangle(self.nx, 2 * self.ny, dx, dy, compliance).T
        if self.mirrored:
            convolution = EvenConvolution(self.nx, self.ny, 2 * self.ny + 1, period)
        else:
            rows = even_fast_length(2 * self.ny + 1)
            convolution = PlainConvolution(self.nx, self.ny, rows, period)
            coefficients = _wrap(coefficients[: self.ny + 1].T, rows).T
        convolution.set_kernel(_wrap(coefficients, period))
        return convolution

    def _strip(self, period, dx):
        convolution = EvenConvolution(self.nx, 0, 1, period)
        convolution.set_kernel(_wrap(influence.strip(self.nx, dx)[None, :], period))
        return convolution

    def apply(self, P, add=0.0):
        """Deflection plus `add`, (blocks, nx+1, W), of the pressure P of the same shape."""
        last = P[-1, :, self.ny % W]
        edge = self._edge(last) + add if self.line else add
        if not self.plane:
            return np.broadcast_to(np.reshape(edge, (1, -1, 1)), P.shape)
        self.plane.source_blocks[:] = P - last[:, None] if self.line else P
        self.plane.run()
        return self.plane.result_blocks + np.reshape(edge, (1, -1, 1))

    def _edge(self, last):
        self.strip.source[0, : self.nx + 1] = last
        self.strip.run()
        return self.strip.result[0, : self.nx + 1].copy()


def _wrap(coefficients, period):
    """Offsets 0..nx laid out for a circular convolution of length `period`."""
    rows, n2 = coefficients.shape
    out = np.zeros((rows, period))
    out[:, :n2] = coefficients
    out[:, period - n2 + 1 :] = coefficients[:, :0:-1]
    return out


class Distribution:
    """K^-1 by its symbol on every level, unpadded (mirrored in y): pressures that give wanted film changes.

    `source` and `result` hold the blocks of all levels one after another, (columns, W) as in the state table.
    """

    def __init__(self, sizes, dx, dy, compliance):
        self.levels, self.cuts, start = [], [], 0
        for l, (nx, ny) in enumerate(sizes):
            convolution = EvenConvolution(nx, ny, ny + 1, even_fast_length(nx + 1))
            period = convolution.source.shape[1]
            convolution.set_symbol(1 / influence.symbol(period, ny, dx * 2**l, dy * 2**l, compliance))
            self.levels.append(convolution)
            self.cuts.append((slice(start, start + (ny // W + 1) * (nx + 1)), (ny // W + 1, nx + 1, W)))
            start = self.cuts[-1][0].stop
        self.source, self.result = np.zeros((start, W)), np.zeros((start, W))

    def run(self):
        """result = K^-1 source on every level."""
        for convolution, (cut, shape) in zip(self.levels, self.cuts):
            convolution.source_blocks[:] = self.source[cut].reshape(shape)
            convolution.run()
            self.result[cut].reshape(shape)[:] = convolution.result_blocks

    def near(self, length=8):
        """Pressure of a unit film change at distances 0..length-1 in its own row and the next: (2 levels, length)."""
        out = np.zeros((2 * len(self.levels), length))
        for l, convolution in enumerate(self.levels):
            convolution.source[0, 0] = 1.0
            convolution.run()
            convolution.source[0, 0] = 0.0
            rows = convolution.result[:2, :length]
            out[2 * l : 2 * l + rows.shape[0]] = rows
        return out
