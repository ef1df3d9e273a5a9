"""FFT operators on pyfftw's own buffers, which the kernels read and write directly (no copies)."""

import numpy as np

from tehl_taichi.engine.fftw import pyfftw
from tehl_taichi.engine.lanes import W
from tehl_taichi.engine.plans import plan

ALIGNED = 16  # numbers between starts that suit FFTW's vector loads
CACHED = 32768  # numbers of a piece of an array on which several operations follow each other


def even_fast_length(n):
    """Smallest even length >= n that FFTW likes (odd ones are slow)."""
    length = pyfftw.next_fast_len(n)
    while length % 2:
        length = pyfftw.next_fast_len(length + 1)
    return length


def block_rows(ny, period, dtype):
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
        self.forward = plan(source[: ny + 1], first, 1)
        self.back = plan(last, result[: ny + 1], 1, "FFTW_BACKWARD")
        self.first, self.last = first.view(self.dtype), last.view(self.dtype)
        self.across = Cosine(ny, rows, 2 * self.half, self.dtype) if rows > 1 else SingleRow(self.dtype)
        self.scale = 1 / (period * (2 * (rows - 1) if rows > 1 else 1))

    @staticmethod
    def spectrum(values):
        """Symbol of the even kernel values (rows, period) laid out for this transform."""
        spectrum = np.fft.rfft(values, axis=1).real
        if len(values) > 1:
            spectrum = np.fft.rfft(np.vstack([spectrum, spectrum[-2:0:-1]]), axis=0).real
        return spectrum

    def set_symbol(self, symbol):
        """Real symbol (rows, period//2+1), for the real and the imaginary parts alike."""
        self.across.set_symbol(np.repeat(symbol * self.scale, 2, axis=1))

    def convolve(self):
        """result = symbol * source."""
        self.forward.execute()
        self.across.convolve(self.first, self.last)
        self.back.execute()


class SingleRow:
    """Multiplication by the symbol of a line."""

    def __init__(self, dtype):
        self.dtype = dtype

    def set_symbol(self, symbol):
        """symbol (1, columns)."""
        self.symbol = symbol.astype(self.dtype)

    def convolve(self, given, wanted):
        """Row `wanted` from the row `given`."""
        np.multiply(given, self.symbol, out=wanted)


class Cosine:
    """Multiplication by a symbol between two cosine transforms (type I) along the rows, as matrix products: ny+1 given rows
    (zeros beyond), `rows` modes.

    Mode m and mode rows-1-m differ by the sign of the odd rows: even and odd rows go apart, to half of the modes each. Products
    use the zero rows and single precision; FFTW's REDFT00 along rows takes far longer (the whole matrix took 0.09 against 0.53
    ms for 129 modes, 2.5 against 6.4 for 513, 20 against 52 for 1025).
    """

    def __init__(self, ny, rows, columns, dtype):
        last = rows - 1
        modes, j = np.arange((rows - 1) // 2 + 1), np.arange(ny + 1)
        cosines = np.cos(np.pi * (np.outer(modes, j) % (2 * last)) / last)
        given, wanted = cosines * _ends(j, last), (cosines.T * _ends(modes, last)).astype(dtype)
        self.to_modes = [np.ascontiguousarray(given[:, odd::2], dtype) for odd in (0, 1)]
        self.to_rows = [np.ascontiguousarray(wanted[odd::2]) for odd in (0, 1)]
        self.even, self.odd = (pyfftw.zeros_aligned((modes.size, columns), dtype) for _ in (0, 1))
        rows_at_once = max(CACHED // columns, 1)
        self.pieces = [slice(k, k + rows_at_once) for k in range(0, modes.size, rows_at_once)]
        self.work = np.zeros((2, rows_at_once, columns), dtype)

    def set_symbol(self, symbol):
        """symbol (rows, columns), by modes."""
        near = symbol[: self.even.shape[0]]
        far = symbol[::-1][: near.shape[0]].copy()
        if symbol.shape[0] % 2:
            far[-1] = 0.0  # the middle one has no partner
        self.sum, self.difference = (np.ascontiguousarray(part, self.even.dtype) for part in (near + far, near - far))

    def convolve(self, given, wanted):
        """Rows `wanted` (ny+1, columns) from the rows `given`."""
        parts = self.even, self.odd
        for odd, matrix, part in zip((0, 1), self.to_modes, parts):
            np.matmul(matrix, given[odd::2], out=part)
        for piece in self.pieces:
            self._mix(piece)
        for odd, matrix, part in zip((0, 1), self.to_rows, parts):
            np.matmul(matrix, part, out=wanted[odd::2])

    def _mix(self, piece):
        """even, odd = sum even + difference odd, difference even + sum odd."""
        even, odd, sums, differences = self.even[piece], self.odd[piece], self.sum[piece], self.difference[piece]
        to_even, to_odd = self.work[:, : even.shape[0]]
        np.multiply(odd, differences, out=to_even)
        np.multiply(even, differences, out=to_odd)
        even *= sums
        odd *= sums
        even += to_even
        odd += to_odd


def _ends(index, last):
    """Weights of a cosine series: 1 for the first and the last term, 2 for the others."""
    return np.where((index == 0) | (index == last), 1.0, 2.0)


class PlainConvolution:
    """The same without a mirror: zero padding in both directions, a full transform along y (source, run, result alike)."""

    def __init__(self, source, result, ny, rows):
        period, self.dtype = source.shape[1], source.dtype
        self.ny, self.half, self.source, self.result = ny, period // 2 + 1, source, result
        self.padded, last = _complex((rows, self.half), self.dtype), _complex((ny + 1, self.half), self.dtype)
        self.first, self.last = self.padded[: ny + 1], last
        self.forward = plan(source[: ny + 1], self.first, 1)
        self.along = plan(self.padded, self.padded, 0)
        self.again = plan(self.padded, self.padded, 0, "FFTW_BACKWARD")
        self.back = plan(last, result[: ny + 1], 1, "FFTW_BACKWARD")
        self.scale = 1 / (period * rows)

    @staticmethod
    def spectrum(values):
        """Symbol of the even kernel values (rows, period) laid out for this transform."""
        return np.fft.fft(np.fft.rfft(values, axis=1).real, axis=0).real

    def set_symbol(self, symbol):
        """Real symbol (rows, period//2+1)."""
        self.symbol = (symbol * self.scale).astype(self.dtype)

    def convolve(self):
        """result = symbol * source."""
        self.padded[self.ny + 1 :] = 0.0
        self.forward.execute()
        self.along.execute()
        np.multiply(self.padded, self.symbol, out=self.padded)
        self.again.execute()
        self.last[:] = self.first
        self.back.execute()


def wrapped(coefficients, period):
    """Offsets 0..nx laid out for a circular convolution of length `period`."""
    rows, n2 = coefficients.shape
    out = np.zeros((rows, period))
    out[:, :n2] = coefficients
    out[:, period - n2 + 1 :] = coefficients[:, :0:-1]  # with a period of twice the cells both ends are the same one
    return out
