"""FFT operators on pyfftw's own buffers, which the kernels read and write directly (no copies).

Plans are estimated and single-threaded: the same sums in the same order on every run and any number of threads.
"""

import numpy as np
import pyfftw

from tehl_taichi.kernels import deflection as kernel
from tehl_taichi.solvers import influence

PLAN = dict(flags=("FFTW_ESTIMATE",), threads=1)


def even_fast_length(n):
    """Smallest even length >= n that FFTW likes (odd ones are slow)."""
    length = pyfftw.next_fast_len(n)
    while length % 2:
        length = pyfftw.next_fast_len(length + 1)
    return length


def _real(*shape):
    return pyfftw.zeros_aligned(shape, dtype="float64")


def _complex(*shape):
    return pyfftw.zeros_aligned(shape, dtype="complex128")


class EvenConvolution:
    """Real transform along x (length nx_period), cosine transform along y (rows 0..rows-1, even about both ends).

    `source` (ny+1, nx_period) -> `result` (ny+1, nx_period) multiplied by the symbol (rows, nx_period//2+1) in between.
    Columns of `source` beyond the grid stay zero, as do the padding rows of the spectrum.
    """

    def __init__(self, ny, rows, nx_period):
        self.rows, self.half = rows, nx_period // 2 + 1
        self.source, self.result = _real(ny + 1, nx_period), _real(ny + 1, nx_period)
        first, self.mixed, last = (_complex(rows, self.half) for _ in range(3))
        cosine = dict(axes=(0,), direction="FFTW_REDFT00", **PLAN)
        forward = pyfftw.FFTW(self.source, first[: ny + 1], axes=(1,), **PLAN)
        back = pyfftw.FFTW(last[: ny + 1], self.result, axes=(1,), direction="FFTW_BACKWARD", **PLAN)
        if rows == 1:
            self.mixed, self.forward, self.back = first, [forward], [pyfftw.FFTW(
                first, self.result, axes=(1,), direction="FFTW_BACKWARD", **PLAN)]
        else:
            pairs = [buffer.view("float64") for buffer in (first, self.mixed, last)]
            self.forward = [forward, pyfftw.FFTW(pairs[0], pairs[1], **cosine)]
            self.back = [pyfftw.FFTW(pairs[1], pairs[2], **cosine), back]
        self.scale = 1 / (nx_period * (2 * (rows - 1) if rows > 1 else 1))
        self.pairs = self.mixed.view("float64")

    def set_kernel(self, values):
        """Symbol from the even kernel values (rows, nx_period) laid out for this transform."""
        buffer = np.zeros((self.rows, self.half))
        spectrum = np.fft.rfft(values, axis=1).real
        if self.rows > 1:
            spectrum = np.fft.rfft(np.vstack([spectrum, spectrum[-2:0:-1]]), axis=0).real
        buffer[:] = spectrum
        self.set_symbol(buffer)

    def set_symbol(self, symbol):
        self.symbol = np.ascontiguousarray(symbol * self.scale)

    def run(self):
        """result = symbol * source; the zeros that pad `source` are kept."""
        for plan in self.forward:
            plan.execute()
        kernel.multiply(self.pairs, self.symbol, self.rows, self.half)
        for plan in self.back:
            plan.execute()


class Deflection:
    """W = K P on one grid: exact coefficients, zero padding; for a line contact the outermost row continues for ever."""

    def __init__(self, nx, ny, dx, dy, kind):
        self.nx, self.ny, self.line = nx, ny, int(kind == "line")
        period = even_fast_length(2 * nx + 1)
        self.edge = np.zeros(nx + 1)
        self.plane = self._plane(period, dx, dy, kind) if ny else None
        self.strip = self._strip(period, dx) if self.line else None
        self.flat = np.zeros((ny + 1, nx + 1))
        self.calls = 0

    def _plane(self, period, dx, dy, kind):
        convolution = EvenConvolution(self.ny, 2 * self.ny + 1, period)
        coefficients = influence.rectangle(self.nx, 2 * self.ny, dx, dy, kind).T
        convolution.set_kernel(_wrap(coefficients, period))
        return convolution

    def _strip(self, period, dx):
        convolution = EvenConvolution(0, 1, period)
        convolution.set_kernel(_wrap(influence.strip(self.nx, dx)[None, :], period))
        return convolution

    def __call__(self, V, n, add, W):
        """W[0] = K V[n] + add, tables of rows over the grid."""
        self.calls += 1
        source = self.plane.source if self.plane else self.flat
        kernel.pack(V, n, self.nx, self.ny, self.line, source, self.edge)
        if self.plane:
            self.plane.run()
        if self.strip:
            self.strip.source[0, : self.nx + 1] = self.edge
            self.strip.run()
            self.edge[:] = self.strip.result[0, : self.nx + 1]
        kernel.unpack(self.plane.result if self.plane else self.flat, self.edge, self.nx, self.ny, add, W, 0)


def _wrap(coefficients, period):
    """Offsets 0..nx laid out for a circular convolution of length `period`."""
    rows, n2 = coefficients.shape
    out = np.zeros((rows, period))
    out[:, :n2] = coefficients
    out[:, period - n2 + 1 :] = coefficients[:, :0:-1]
    return out


class Distribution:
    """K^-1 by its symbol, unpadded (mirrored in y): the pressure that gives a wanted film change. A preconditioner."""

    def __init__(self, nx, ny, dx, dy, kind):
        period = even_fast_length(nx + 1)
        self.convolution = EvenConvolution(ny, ny + 1, period)
        self.convolution.set_symbol(1 / influence.symbol(period, ny, dx, dy, kind))
        self.source, self.result = self.convolution.source, self.convolution.result
        self.run = self.convolution.run

    def near(self, length=8):
        """Pressure of a unit film change at distances 0..length-1 in its own row and the next; shape (2, length)."""
        self.source[:] = 0.0
        self.source[0, 0] = 1.0
        self.run()
        self.source[:] = 0.0
        out = np.zeros((2, length))
        rows = self.result[:2, :length]
        out[: rows.shape[0]] = rows
        return out
