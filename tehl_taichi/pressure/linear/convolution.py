"""The deflection K and the distribution K^-1 as convolutions inside kernels, on a pair of blocks or a group of waves.

Along x: a real transform of period 2 M, at least twice the cells (K) or the cells (K^-1, which is periodic). It is computed as
a complex transform of half the length, on the rows of two blocks in neighbouring lanes.

Along y: rows are mirrored at y = 0, so the matrices are Toeplitz plus Hankel: Y(k) = A(k) X(k) + B(k) X(-k), by complex
transforms of length N >= 2 ny, with GROUP waves in the lanes. A is the transform of the even kernel t(0), t(1), ...; B is that
of t(0 ... 2 ny - 1) for the mirror images (0 for a whole domain, A if the other end is also a mirror). Rows on a mirror count
half.

A line contact continues its outermost row for ever (a whole domain the mean of both): it is subtracted, and the response of a
strip is added. Cosine transforms from running sums would lose digits: 1e-5 in single precision for 512 rows.
"""

import functools
import itertools

import numpy as np

from tehl_taichi.engine import simd
from tehl_taichi.engine.fft import Lengths, fast_length, transform
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import W, cells
from tehl_taichi.engine.task_pool import team_size
from tehl_taichi.pressure import influence

GROUP = 2 * W  # rows transformed together along x, and waves transformed together along y, by the same code
THERE, ACROSS, BACK = range(3)  # steps: along x to the waves; along y, times the symbol, and back; back along x
_column = itertools.count()
LEVEL, M, N, NY, PAIRS, GROUPS, STEP = (next(_column) for _ in range(7))  # STEP: entries from row to row of the spectra
SPECTRA, SYMBOL, STRIP, SPLIT = (next(_column) for _ in range(4))  # first entries in the field Y; SPLIT: first twiddle factor
X_ROW, X_ROWS, Y_ROW, Y_ROWS = (next(_column) for _ in range(4))  # first pass and number of passes of both transforms
HALF_FIRST, HALF_LAST, ENDLESS = (next(_column) for _ in range(3))  # whether end rows lie on a mirror; the outermost continues
WORK, SIZE = (next(_column) for _ in range(2))  # first entry and size of the buffers, two for each worker
COLUMNS = next(_column)


class TransformSize:
    """Lengths of one convolution.

    level: number of the level; nx, ny: cells; least: smallest period along x. Attributes: M, N: lengths of the complex
    transforms; groups, pairs: numbers of groups of waves and pairs of blocks; step: entries of a row of the spectra.
    """

    def __init__(self, level, nx, ny, least):
        self.level, self.nx, self.ny = level, nx, ny
        self.M, self.further = fast_length(-(-least // 2)), fast_length(max(ny, 1))
        self.N, self.groups, self.pairs = 2 * self.further, -(-(self.M + 1) // GROUP), ny // GROUP + 1
        self.step = 2 * self.groups


def transform_sizes(sizes, lines):
    """TransformSizes: of the deflection on the finest level, then of the distributions on the levels `lines`.

    sizes: (nx, ny) of each level. The distributions have the period of the cells, for a single row twice that: no further
    radices, and less work (20 steps of furrow-line: 25 Newton and 92 Krylov iterations; 26 and 96 with a period of one cell
    more).
    """
    periods = [nx * (1 if ny else 2) for nx, ny in sizes]
    return [TransformSize(0, *sizes[0], 2 * sizes[0][0]), *(TransformSize(l, *sizes[l], periods[l]) for l in lines)]


class Layout:
    """Table of the convolutions, with their places in the fields Y (spectra, symbols, buffers) and T (twiddle factors).

    shapes: see :func:`transform_sizes`. Attributes: `y`, `t`: sizes of Y and T. Every worker has its own buffers.
    """

    def __init__(self, shapes):
        self.lengths, self.table = Lengths(), np.zeros((len(shapes), COLUMNS), np.int32)
        sizes = (n for c in shapes for n in (c.pairs * GROUP * c.step, self.symbols(c), c.groups))
        entries = itertools.accumulate(sizes, initial=0)
        for row, c in zip(self.table, shapes):
            places = next(entries), next(entries), next(entries)
            split = self.lengths.turns(np.arange(c.M // 2 + 1), 2 * c.M)
            row[: WORK] = (c.level, c.M, c.N, c.ny, c.pairs, c.groups, c.step, *places, split, *self.lengths.place(c.M),
                           *self.lengths.place(c.N), 0, 0, 0)
        size = max(2 * max(c.groups * GROUP, c.N) for c in shapes) + 2
        self.table[:, WORK:] = next(entries), size
        workers = team_size(max(sum(c.pairs for c in shapes), sum(c.groups for c in shapes)))
        self.y, self.t = int(self.table[0, WORK]) + 2 * workers * size, len(self.lengths.twiddles())

    @staticmethod
    def symbols(c):
        """Number of entries of the symbols of one convolution."""
        return 3 * c.groups * (c.N // 2 + 1)


class Symbols:
    """Symbols of one convolution: A, B (N//2+1, M+1), strip (M+1,).

    shape: its TransformSize; mirrors: whether the first and the last row lie on a mirror; endless: whether the outermost row
    continues for ever (of a whole domain the mean of both).
    """

    def __init__(self, shape, A, B, strip, mirrors, endless):
        self.shape, self.A, self.B, self.strip, self.mirrors, self.endless = shape, A, B, strip, mirrors, endless

    def entries(self):
        """Entries (n, GROUP): A, Re B, Im B of each group, then the strip; with the factors 1/M, 1/N of the transforms."""
        c = self.shape
        parts = np.zeros((3, c.N // 2 + 1, c.groups * GROUP))
        parts[:, :, : c.M + 1] = np.stack([self.A, self.B.real, self.B.imag]) / (c.M * c.N)
        strip = np.zeros(c.groups * GROUP)
        strip[: c.M + 1] = self.strip / c.M
        by_group = parts.reshape(3, c.N // 2 + 1, c.groups, GROUP).transpose(2, 1, 0, 3)
        return np.concatenate([by_group.reshape(-1, GROUP), strip.reshape(-1, GROUP)])

    def near(self, length):
        """Response in rows 0 and 1 to a unit in row 0 at distances 0 .. length-1 along x, both ends mirrors: (2, length)."""
        rows = np.vstack([self.strip, 0 * self.strip])
        if self.shape.ny:
            rows = np.fft.ifft(np.vstack([self.A, self.A[-2:0:-1]]), axis=0)[:2].real
        return np.fft.irfft(rows, 2 * self.shape.M, axis=1)[:, :length]


def deflection(shape, levels):
    """Symbols of K on the finest level."""
    nx, ny, dx, dy = levels.grid(0)
    A, B = _deflection_symbols(nx, ny, dx, dy, levels.scales.compliance, levels.mirrored, 2 * shape.M, shape.N)
    strip = waves(influence.strip(nx, dx)[None, :], 2 * shape.M)[0] if levels.line else np.zeros(shape.M + 1)
    return Symbols(shape, A, B, strip, (levels.mirrored and ny > 0, False), levels.line)


@functools.lru_cache(maxsize=2)  # a grid is solved in single and in double precision
def _deflection_symbols(nx, ny, dx, dy, compliance, mirrored, period, N):
    """(A, B) of the deflection on a grid."""
    if ny == 0:
        return (np.zeros((N // 2 + 1, period // 2 + 1)),) * 2
    t = waves(influence.rectangle(nx, 2 * ny, dx, dy, compliance).T, period)
    even, later = np.zeros((2, N, period // 2 + 1))
    even[: ny + 1], even[N - ny :] = t[: ny + 1], t[ny:0:-1]
    later[: 2 * ny] = mirrored * t[: 2 * ny]
    return np.fft.rfft(even, axis=0).real, np.fft.rfft(later, axis=0)


def distribution(shape, levels):
    """Symbols of K^-1 on a level, with mirrors at both ends of y (the far one beyond the grid if its number of rows has large
    prime factors)."""
    nx, ny, dx, dy = levels.grid(shape.level)
    A = 1 / influence.symbol(2 * shape.M, shape.further if ny else 0, dx, dy, levels.scales.compliance)
    if ny == 0:
        return Symbols(shape, np.zeros((2, shape.M + 1)), np.zeros((2, shape.M + 1)), A[0], (False, False), False)
    return Symbols(shape, A, A, np.zeros(shape.M + 1), (True, ny == shape.further), False)


def prepare(table, symbols, fields, lengths, dtype):
    """Write symbols and twiddle factors of the convolutions into the fields Y and T, and their flags into the table.

    table, lengths: of a :class:`Layout`; symbols: of each convolution; fields: all fields that the caller fills, Y and T first.
    """
    Y, T, *_ = fields
    simd.fill(*simd.one_of(fields, T), 0, 0, lengths.twiddles().astype(dtype))
    for row, one in zip(table, symbols):
        row[[HALF_FIRST, HALF_LAST, ENDLESS]] = *one.mirrors, one.endless
        simd.fill(*simd.one_of(fields, Y), 0, int(row[SYMBOL]), one.entries().astype(dtype))


def waves(coefficients, period):
    """Real transforms (rows, period//2+1) along x of even kernels, given at offsets 0 .. nx: (rows, nx+1)."""
    rows, n2 = coefficients.shape
    out = np.zeros((rows, period))
    out[:, :n2] = coefficients
    out[:, period - n2 + 1 :] = coefficients[:, :0:-1]  # offset nx is its own image for a period of 2 nx
    return np.fft.rfft(out, axis=1).real


@ti.func
def other(a, start, size):
    """The other one of two buffers of `size` entries from `start` on."""
    return 2 * start + size - a


@ti.func
def pair(G: ti.template(), l, j):
    """(first column of both blocks of pair j of level l in the table of all levels, number of their columns).

    The last pair may be one block twice: then the work on the first one counts, and is done last.
    """
    nx, ny, off = cells(G, l)
    return off + 2 * j * (nx + 1), off + ti.min(2 * j + 1, ny // W) * (nx + 1), nx + 1


@ti.func
def side_by_side(a, b):
    """Lanes of a pair from those of its two blocks."""
    return ti.Vector([a[u] for u in ti.static(range(W))] + [b[u] for u in ti.static(range(W))])


@ti.func
def first_of(pair):
    """Lanes of the first block of a pair."""
    return ti.Vector([pair[u] for u in ti.static(range(W))])


@ti.func
def second_of(pair):
    """Lanes of the second block of a pair."""
    return ti.Vector([pair[W + u] for u in ti.static(range(W))])


@ti.func
def clear(Y: ti.template(), first, end):
    """Zero in the entries from `first` to before `end`."""
    for i in range(first, end):
        Y[0, i] = ti.Vector([ti.cast(0.0, Y.dtype) for _ in ti.static(range(GROUP))])


@ti.func
def split(Y: ti.template(), z, o, T: ti.template(), C: ti.template(), c):
    """Real transforms (waves 0 .. M) at entry o from complex ones at z, whose real parts came from even columns, imaginary
    parts from odd ones."""
    half, m, turns = ti.cast(0.5, Y.dtype), C[c, M], C[c, SPLIT]
    for k in range(m // 2 + 1):
        k1, k2 = m - k, (m - k) % m
        ar, ai, br, bi = Y[0, z + 2 * k], Y[0, z + 2 * k + 1], Y[0, z + 2 * k2], Y[0, z + 2 * k2 + 1]
        er, ei, dr, di = half * (ar + br), half * (ai - bi), half * (ai + bi), half * (br - ar)
        w = T[0, turns + k]
        tr, tj = dr * w[0] - di * w[1], dr * w[1] + di * w[0]
        Y[0, o + 2 * k1], Y[0, o + 2 * k1 + 1] = er - tr, tj - ei
        Y[0, o + 2 * k], Y[0, o + 2 * k + 1] = er + tr, ei + tj


@ti.func
def merge(Y: ti.template(), o, z, T: ti.template(), C: ti.template(), c):
    """The inverse of :func:`split`."""
    half, m, turns = ti.cast(0.5, Y.dtype), C[c, M], C[c, SPLIT]
    for k in range(m // 2 + 1):
        k1, k2 = m - k, (m - k) % m
        pr, pi, qr, qi = Y[0, o + 2 * k], Y[0, o + 2 * k + 1], Y[0, o + 2 * k1], Y[0, o + 2 * k1 + 1]
        er, ei, dr, di = half * (pr + qr), half * (pi - qi), half * (pr - qr), half * (pi + qi)
        w = T[0, turns + k]
        tr, tj = dr * w[0] + di * w[1], di * w[0] - dr * w[1]
        Y[0, z + 2 * k2], Y[0, z + 2 * k2 + 1] = er + tj, tr - ei
        Y[0, z + 2 * k], Y[0, z + 2 * k + 1] = er - tj, ei + tr


@ti.func
def exchange(Y: ti.template(), o, C: ti.template(), c, j, way):
    """Transpose between the waves of pair j at o (rows in lanes) and the spectra (waves in lanes), GROUP vectors at a time."""
    step = C[c, STEP]
    first = C[c, SPECTRA] + j * GROUP * step
    for n in range(step):
        waves, spectra = o + 2 * GROUP * (n >> 1) + (n & 1), first + n
        source, by, target, to = waves, 2, spectra, step
        if way == BACK:
            source, by, target, to = spectra, step, waves, 2
        given = [Y[0, source + t * by] for t in ti.static(range(GROUP))]
        for u in ti.static(range(GROUP)):
            Y[0, target + u * to] = ti.Vector([given[t][u] for t in ti.static(range(GROUP))])


@ti.func
def buffer(C: ti.template(), w):
    """First entry of the buffers of worker w in Y."""
    return C[0, WORK] + 2 * w * C[0, SIZE]


@ti.func
def beyond(Y: ti.template(), C: ti.template(), c, e, part):
    """Real or imaginary parts (0, 1) of a group of waves of the pressure beyond the grid: of the outermost row, of a whole
    domain of the mean of both, so that both of its sides are alike."""
    last, first = Y[0, e + C[c, NY] * C[c, STEP] + part], Y[0, e + part]
    share = ti.cast(0.5 * (1 - C[c, HALF_FIRST]), Y.dtype)
    return last + share * (first - last)


@ti.func
def load_waves(Y: ti.template(), C: ti.template(), c, e, a):
    """Copy a group of waves from entry e of the spectra to the buffer at a: an endless pressure :func:`beyond` is subtracted,
    the rest of the buffer is zero."""
    ny, step = C[c, NY], C[c, STEP]
    rest = ti.cast(C[c, ENDLESS], Y.dtype)
    lr, li = rest * beyond(Y, C, c, e, 0), rest * beyond(Y, C, c, e, 1)
    for j in range(ny + 1):
        Y[0, a + 2 * j], Y[0, a + 2 * j + 1] = Y[0, e + j * step] - lr, Y[0, e + j * step + 1] - li
    clear(Y, a + 2 * (ny + 1), a + 2 * C[c, N])
    half = ti.cast(0.5, Y.dtype)
    if C[c, HALF_FIRST] == 1:
        Y[0, a], Y[0, a + 1] = half * Y[0, a], half * Y[0, a + 1]
    if C[c, HALF_LAST] == 1:
        Y[0, a + 2 * ny], Y[0, a + 2 * ny + 1] = half * Y[0, a + 2 * ny], half * Y[0, a + 2 * ny + 1]


@ti.func
def multiply(Y: ti.template(), z, C: ti.template(), c, g):
    """Y(k) = A(k) X(k) + B(k) X(-k), in place."""
    n = C[c, N]
    first = C[c, SYMBOL] + g * (n // 2 + 1) * 3
    for k in range(n // 2 + 1):
        k1, k2, q = z + 2 * k, z + 2 * ((n - k) % n), first + 3 * k
        pr, pi, qr, qi = Y[0, k1], Y[0, k1 + 1], Y[0, k2], Y[0, k2 + 1]
        A, Br, Bi = Y[0, q], Y[0, q + 1], Y[0, q + 2]
        Y[0, k2], Y[0, k2 + 1] = A * qr + Br * pr + Bi * pi, A * qi + Br * pi - Bi * pr
        Y[0, k1], Y[0, k1 + 1] = A * pr + Br * qr - Bi * qi, A * pi + Br * qi + Bi * qr


@ti.func
def store_waves(Y: ti.template(), z, C: ti.template(), c, e, g):
    """Copy a group of waves from the buffer back to the spectra, plus the response of the strip to the pressure beyond."""
    ny, step, strip = C[c, NY], C[c, STEP], Y[0, C[c, STRIP] + g]
    lr, li = strip * beyond(Y, C, c, e, 0), strip * beyond(Y, C, c, e, 1)
    for j in range(ny + 1):
        Y[0, e + j * step], Y[0, e + j * step + 1] = Y[0, z + 2 * j] + lr, Y[0, z + 2 * j + 1] + li


@ti.func
def transformed(Y: ti.template(), T: ti.template(), Q: ti.template(), odd: ti.template(), C: ti.template(), c, j, w, way):
    """One step of a convolution, in the buffers of worker w; returns the first entry of the result.

    way THERE: rows of pair j of blocks to the spectra. ACROSS: group j of waves times the symbol. BACK: pair j from the
    spectra.
    """
    a, size, row, rows = buffer(C, w), C[c, SIZE], C[c, X_ROW], C[c, X_ROWS]
    z, o, e = a, a, C[c, SPECTRA] + 2 * j
    for half in range(2):  # so that `exchange`, a fifth of the code, stands here once
        if way == (BACK if half == 0 else THERE):
            exchange(Y, o, C, c, j, way)
        if half == 0:
            if way == ACROSS:
                row, rows = C[c, Y_ROW], C[c, Y_ROWS]
                load_waves(Y, C, c, e, a)
            elif way == BACK:
                z = a + size
                merge(Y, a, z, T, C, c)
            for turn in range(2 if way == ACROSS else 1):
                z = transform(Y, z, other(z, a, size), T, Q, odd, row, rows, turn + way // BACK)
                if way == ACROSS and turn == 0:
                    multiply(Y, z, C, c, j)
            if way == ACROSS:
                store_waves(Y, z, C, c, e, j)
            elif way == THERE:
                o = other(z, a, size)
                split(Y, z, o, T, C, c)
    return z
