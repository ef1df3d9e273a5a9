"""FFT operators on pyfftw's own buffers, which the kernels read and write directly (no copies).

Plans are estimated and single-threaded: the same sums in the same order on every run and any number of threads. (FFTW's
own threads halve a lone transform, but between kernel launches they have gone to sleep: 0.58 -> 1.97 ms a distribution.)
"""

import numpy as np
import pyfftw

from tehl_taichi.kernels.lanes import W
from tehl_taichi.solvers import influence

PLAN = dict(flags=("FFTW_ESTIMATE",), threads=1)
ALIGNED = 16  # numbers between starts that suit FFTW's vector loads


def even_fast_length(n):
    """Smallest even length >= n that FFTW likes (odd ones are slow)."""
    length = pyfftw.next_fast_len(n)
    while length % 2:
        length = pyfftw.next_fast_len(length + 1)
    return length


def _rows(ny, period, dtype):
    """Zero array of the rows of all blocks of lanes, the last one whole: (blocks W, period)."""
    return pyfftw.zeros_aligned((padded_rows(ny), period), dtype)


def padded_rows(ny):
    """Rows of the blocks of lanes that ny + 1 rows take."""
    return (ny // W + 1) * W


def _complex(shape, dtype):
    return pyfftw.zeros_aligned(shape, np.result_type(dtype, np.complex64))


class EvenConvolution:
    """Real transform along x (length `period`), cosine transform along y (`rows` modes, even about both ends).

    `source` -> `result`, multiplied by the symbol (rows, period//2+1) in between: arrays of at least ny+1 rows and of
    `period` columns, of which those beyond the nx+1 of the grid must stay zero in `source`.
    """

    def __init__(self, source, result, ny, rows):
        period, self.dtype = source.shape[1], source.dtype
        self.rows, self.half, self.source, self.result = rows, period // 2 + 1, source, result
        first, last = (_complex((ny + 1, self.half), self.dtype) for _ in range(2))
        self.forward = pyfftw.FFTW(source[: ny + 1], first, axes=(1,), **PLAN)
        self.back = pyfftw.FFTW(last, result[: ny + 1], axes=(1,), direction="FFTW_BACKWARD", **PLAN)
        self.first, self.last = first.view(self.dtype), last.view(self.dtype)
        self.cosine = Cosine(ny, rows, 2 * self.half, self.dtype)
        self.scale = 1 / (period * (2 * (rows - 1) if rows > 1 else 1))

    def set_kernel(self, values):
        """Symbol from the even kernel values (rows, period) laid out for this transform."""
        spectrum = np.fft.rfft(values, axis=1).real
        if self.rows > 1:
            spectrum = np.fft.rfft(np.vstack([spectrum, spectrum[-2:0:-1]]), axis=0).real
        self.set_symbol(spectrum)

    def set_symbol(self, symbol):
        """Real symbol (rows, period//2+1), stored twice: for the real and the imaginary parts."""
        self.symbol = np.repeat(symbol * self.scale, 2, axis=1).astype(self.dtype)

    def convolve(self):
        """result = symbol * source."""
        self.forward.execute()
        spectrum = self.cosine.forward(self.first)
        np.multiply(spectrum, self.symbol, out=spectrum)
        self.cosine.back(spectrum, self.last)
        self.back.execute()


class Cosine:
    """Cosine transform (type I) along the rows as a matrix product: ny+1 given rows (zeros beyond) <-> `rows` modes.

    It uses the zero rows and single precision; FFTW's REDFT00 along rows takes 2 to 6 times as long (129 modes 0.09 against
    0.53 ms, 513 modes 2.5 against 6.4 ms, 1025 modes 20 against 52 ms, in single precision).
    """

    def __init__(self, ny, rows, columns, dtype):
        self.spectrum = pyfftw.zeros_aligned((rows, columns), dtype)
        j, last = np.arange(rows), max(rows - 1, 1)
        weight = np.full(rows, 2.0)
        weight[[0, -1]] = 1.0
        matrix = (np.cos(np.pi * (np.outer(j, j) % (2 * last)) / last) * weight).astype(dtype)
        self.to_modes = np.ascontiguousarray(matrix[:, : ny + 1])
        self.to_rows = np.ascontiguousarray(matrix[: ny + 1])

    def forward(self, values):
        """Modes (rows, columns) of values (ny+1, columns); an own buffer."""
        return np.matmul(self.to_modes, values, out=self.spectrum)

    def back(self, spectrum, values):
        """Rows 0..ny of the modes into `values` (unnormalised)."""
        np.matmul(self.to_rows, spectrum, out=values)


class PlainConvolution:
    """The same without a mirror: zero padding in both directions, a full transform along y (source, run, result alike)."""

    def __init__(self, source, result, ny, rows):
        period, self.dtype = source.shape[1], source.dtype
        self.ny, self.half, self.source, self.result = ny, period // 2 + 1, source, result
        self.padded, last = _complex((rows, self.half), self.dtype), _complex((ny + 1, self.half), self.dtype)
        self.first, self.last = self.padded[: ny + 1], last
        self.forward = pyfftw.FFTW(source[: ny + 1], self.first, axes=(1,), **PLAN)
        self.along = pyfftw.FFTW(self.padded, self.padded, axes=(0,), **PLAN)
        self.again = pyfftw.FFTW(self.padded, self.padded, axes=(0,), direction="FFTW_BACKWARD", **PLAN)
        self.back = pyfftw.FFTW(last, result[: ny + 1], axes=(1,), direction="FFTW_BACKWARD", **PLAN)
        self.scale = 1 / (period * rows)

    def set_kernel(self, values):
        """Symbol from the even kernel values (rows, period) laid out for this transform."""
        symbol = np.fft.fft(np.fft.rfft(values, axis=1).real, axis=0).real * self.scale
        self.symbol = symbol.astype(self.dtype)

    def convolve(self):
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
    y < 0 are the mirror image of the others.

    The pressure must vanish in the first column, and in the first row of a grid that is not mirrored: an even period of
    twice the cells is exact then. It is written into `pressure`; the deflection is `film` + `edge`, rows (of whole blocks
    of lanes, `period` columns) plus one line for all rows.
    """

    def __init__(self, nx, ny, dx, dy, compliance, line, mirrored=True, dtype=float):
        self.nx, self.ny, self.line, self.mirrored, self.dtype = nx, ny, line, mirrored, dtype
        period = even_fast_length(2 * nx)
        self.pressure, self.film = _rows(ny, period, dtype), _rows(ny, period, dtype)
        self.edge = np.zeros(nx + 1, dtype)
        self.plane = self._plane(period, dx, dy, compliance) if ny else None
        self.strip = self._strip(period, dx) if line else None

    def _plane(self, period, dx, dy, compliance):
        coefficients = influence.rectangle(self.nx, 2 * self.ny, dx, dy, compliance).T
        if self.mirrored:
            convolution = EvenConvolution(self.pressure, self.film, self.ny, 2 * self.ny + 1)
        else:
            rows = even_fast_length(2 * self.ny)
            convolution = PlainConvolution(self.pressure, self.film, self.ny, rows)
            coefficients = _wrap(coefficients[: self.ny + 1].T, rows).T
        convolution.set_kernel(_wrap(coefficients, period))
        return convolution

    def _strip(self, period, dx):
        source, result = (pyfftw.zeros_aligned((1, period), self.dtype) for _ in range(2))
        convolution = EvenConvolution(source, result, 0, 1)
        convolution.set_kernel(_wrap(influence.strip(self.nx, dx)[None, :], period))
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


def _wrap(coefficients, period):
    """Offsets 0..nx laid out for a circular convolution of length `period`."""
    rows, n2 = coefficients.shape
    out = np.zeros((rows, period))
    out[:, :n2] = coefficients
    out[:, period - n2 + 1 :] = coefficients[:, :0:-1]  # with a period of twice the cells both ends are the same one
    return out


class Distribution:
    """K^-1 by its symbol on every level, unpadded (mirrored in y): pressures that give wanted film changes.

    `source` and `result` are flat: rows of all levels one after another; `places[l]` = (first number, period) of level l.
    """

    def __init__(self, sizes, dx, dy, compliance, dtype=float):
        periods = [even_fast_length(nx + 1) for nx, _ in sizes]
        lengths = [-(-padded_rows(ny) * period // ALIGNED) * ALIGNED for (_, ny), period in zip(sizes, periods)]
        self.source, self.result = (pyfftw.zeros_aligned(sum(lengths), dtype) for _ in range(2))
        self.places, self.levels = list(zip(np.cumsum([0, *lengths[:-1]]).tolist(), periods)), []
        for l, ((_, ny), (start, period)) in enumerate(zip(sizes, self.places)):
            source, result = (flat[start : start + padded_rows(ny) * period].reshape(-1, period)
                              for flat in (self.source, self.result))
            convolution = EvenConvolution(source, result, ny, ny + 1)
            convolution.set_symbol(1 / influence.symbol(period, ny, dx * 2**l, dy * 2**l, compliance))
            self.levels.append(convolution)

    def distribute(self):
        """result = K^-1 source on every level."""
        for convolution in self.levels:
            convolution.convolve()

    def near(self, length=8):
        """Pressure of a unit film change at distances 0..length-1 in its own row and the next: (2 levels, length)."""
        out = np.zeros((2 * len(self.levels), length), self.source.dtype)
        for l, convolution in enumerate(self.levels):
            convolution.source[0, 0] = 1.0
            convolution.convolve()
            convolution.source[0, 0] = 0.0
            rows = convolution.result[:2, :length]
            out[2 * l : 2 * l + rows.shape[0]] = rows
        return out
