"""The deflection K and the distribution K^-1 as convolutions inside kernels: for a block of rows, or a group of their waves.

Along x a real transform of period 2 M >= twice the cells (K; of the cells for K^-1, which is periodic), done as a complex one
of half the length on a block of W rows in lanes. Along y Toeplitz plus Hankel matrices, rows being mirrored at y = 0:
Y(k) = A(k) X(k) + B(k) X(-k), by complex transforms of length N >= 2 ny over the waves along x, GROUP of them in lanes. A is
the transform of the even kernel t(0), t(1), ..., B that of t(0 ... 2 ny - 1) for the mirror images (0 for a whole domain, A
where the other end is a mirror, too), the rows on a mirror count half. A line contact continues its outermost row for ever:
that is subtracted, and what the strip answers is added. Cosine transforms from running sums would lose digits: 1e-5 in single
precision for 512 rows.
"""

import functools
import itertools

import numpy as np

from tehl_taichi.engine import lanes
from tehl_taichi.engine.fft import Lengths, fast_length, transform
from tehl_taichi.engine.lanes import W
from tehl_taichi.engine.language import ti
from tehl_taichi.pressure import influence

GROUP = 8  # waves along x that go along y side by side
_column = itertools.count()
LEVEL, M, N, NY, GROUPS, STEP = (next(_column) for _ in range(6))  # STEP: entries from row to row of the spectra
SPECTRA, SYMBOL, STRIP, SPLIT = (next(_column) for _ in range(4))  # first entries: in the field of groups; twiddle factors
X_ROW, X_ROWS, Y_ROW, Y_ROWS = (next(_column) for _ in range(4))  # passes of both transforms
HALF_FIRST, HALF_LAST, ENDLESS = (next(_column) for _ in range(3))  # rows on a mirror; an outermost row that goes on
WORK_X, SIZE_X, WORK_Y, SIZE_Y = (next(_column) for _ in range(4))  # first entry and size of the buffers, two of each worker
COLUMNS = next(_column)


class Shape:
    """Lengths of one convolution: nx, ny: cells; least: period along x that it needs; M, N: of the complex transforms."""

    def __init__(self, level, nx, ny, least):
        self.level, self.nx, self.ny = level, nx, ny
        self.M, self.further = fast_length(-(-least // 2)), fast_length(max(ny, 1))
        self.N, self.groups, self.rows = 2 * self.further, -(-(self.M + 1) // GROUP), (ny // W + 1) * W
        self.step = 2 * self.groups


def shapes(sizes, lines):
    """Of the deflection on the finest grid and the distributions on `lines` (profiles: both ends apart, fewer Newton steps)."""
    return [Shape(0, *sizes[0], 2 * sizes[0][0]), *(Shape(l, *sizes[l], sizes[l][0] + (sizes[l][1] == 0)) for l in lines)]


class Layout:
    """Table of convolutions and places in the fields (of rows X, groups Y, twiddle factors T); `x`, `y`, `t`: their sizes.

    shapes: see :func:`shapes`; before: entries of X that something else takes; workers: how many need buffers.
    """

    def __init__(self, shapes, before, workers):
        self.lengths, self.table = Lengths(), np.zeros((len(shapes), COLUMNS), np.int32)
        entries = itertools.accumulate((n for c in shapes for n in (c.rows * c.step, self.symbols(c), c.groups)), initial=0)
        for row, c in zip(self.table, shapes):
            places = next(entries), next(entries), next(entries)
            split = self.lengths.turns(np.arange(c.M // 2 + 1), 2 * c.M)
            row[: WORK_X] = (c.level, c.M, c.N, c.ny, c.groups, c.step, *places, split, *self.lengths.place(c.M),
                             *self.lengths.place(c.N), 0, 0, 0)
        size_x, size_y = max(2 * c.groups * GROUP for c in shapes) + 2, max(2 * c.N for c in shapes) + 2
        self.table[:, WORK_X:] = before, size_x, next(entries), size_y
        self.x, self.y = before + 2 * workers * size_x, int(self.table[0, WORK_Y]) + 2 * workers * size_y
        self.t = len(self.lengths.twiddles())

    @staticmethod
    def symbols(c):
        return 3 * c.groups * (c.N // 2 + 1)


class Symbols:
    """Symbols of one convolution: A, B (N//2+1, M+1), strip (M+1,); mirrors: whether the first and the last row are; endless:
    whether the outermost row goes on for ever."""

    def __init__(self, shape, A, B, strip, mirrors, endless):
        self.shape, self.A, self.B, self.strip, self.mirrors, self.endless = shape, A, B, strip, mirrors, endless

    def entries(self):
        """Entries (., GROUP): A, Re B, Im B of group after group, then the strip; with the transforms' factors 1/M, 1/N."""
        c = self.shape
        parts = np.zeros((3, c.N // 2 + 1, c.groups * GROUP))
        parts[:, :, : c.M + 1] = np.stack([self.A, self.B.real, self.B.imag]) / (c.M * c.N)
        strip = np.zeros(c.groups * GROUP)
        strip[: c.M + 1] = self.strip / c.M
        by_group = parts.reshape(3, c.N // 2 + 1, c.groups, GROUP).transpose(2, 1, 0, 3)
        return np.concatenate([by_group.reshape(-1, GROUP), strip.reshape(-1, GROUP)])

    def near(self, length):
        """What a unit in row 0 causes in rows 0 and 1 at distances 0 .. length-1 along x, both ends mirrors: (2, length)."""
        rows = np.vstack([self.strip, 0 * self.strip])
        if self.shape.ny:
            rows = np.fft.ifft(np.vstack([self.A, self.A[-2:0:-1]]), axis=0)[:2].real
        return np.fft.irfft(rows, 2 * self.shape.M, axis=1)[:, :length]


def deflection(shape, levels):
    """K of the finest level."""
    nx, ny, dx, dy = levels.grid(0)
    A, B = _deflection_symbols(nx, ny, dx, dy, levels.scales.compliance, levels.mirrored, 2 * shape.M, shape.N)
    strip = waves(influence.strip(nx, dx)[None, :], 2 * shape.M)[0] if levels.line else np.zeros(shape.M + 1)
    return Symbols(shape, A, B, strip, (levels.mirrored and ny > 0, False), levels.line)


@functools.lru_cache(maxsize=2)  # a grid is solved in single and in double precision
def _deflection_symbols(nx, ny, dx, dy, compliance, mirrored, period, N):
    if ny == 0:
        return (np.zeros((N // 2 + 1, period // 2 + 1)),) * 2
    t = waves(influence.rectangle(nx, 2 * ny, dx, dy, compliance).T, period)
    even, later = np.zeros((2, N, period // 2 + 1))
    even[: ny + 1], even[N - ny :] = t[: ny + 1], t[ny:0:-1]
    later[: 2 * ny] = mirrored * t[: 2 * ny]
    return np.fft.fft(even, axis=0)[: N // 2 + 1].real, np.fft.fft(later, axis=0)[: N // 2 + 1]


def distribution(shape, levels):
    """K^-1 of the level, with mirrors at both ends (the further one beyond the grid where its number of rows is unwieldy)."""
    nx, ny, dx, dy = levels.grid(shape.level)
    A = 1 / influence.symbol(2 * shape.M, shape.further if ny else 0, dx, dy, levels.scales.compliance)
    if ny == 0:
        return Symbols(shape, np.zeros((2, shape.M + 1)), np.zeros((2, shape.M + 1)), A[0], (False, False), False)
    return Symbols(shape, A, A, np.zeros(shape.M + 1), (True, ny == shape.further), False)


def prepare(table, symbols, Y, T, lengths, dtype):
    """Put what the convolutions of a :class:`Layout` need into its `table` and the fields Y and T. symbols: of each."""
    lanes.fill(T, 0, 0, lengths.twiddles().astype(dtype))
    for row, one in zip(table, symbols):
        row[[HALF_FIRST, HALF_LAST, ENDLESS]] = *one.mirrors, one.endless
        lanes.fill(Y, 0, int(row[SYMBOL]), one.entries().astype(dtype))


def waves(coefficients, period):
    """Real transforms along x of kernels of which the offsets 0 .. nx are given (rows, nx+1); even."""
    rows, n2 = coefficients.shape
    out = np.zeros((rows, period))
    out[:, :n2] = coefficients
    out[:, period - n2 + 1 :] = coefficients[:, :0:-1]  # with a period of twice the cells both ends are the same one
    return np.fft.rfft(out, axis=1).real


@ti.func
def other(a, start, size):
    """The other one of two buffers of `size` entries from `start` on."""
    return 2 * start + size - a


@ti.func
def split(X: ti.template(), z, o, T: ti.template(), C: ti.template(), c):
    """Real transforms at o, waves 0 .. M, from the complex ones at z of which even numbers are the real part, odd ones the
    imaginary."""
    half, m, turns = ti.cast(0.5, X.dtype), C[c, M], C[c, SPLIT]
    for k in range(m // 2 + 1):
        k1, k2 = m - k, (m - k) % m
        ar, ai, br, bi = X[0, z + 2 * k], X[0, z + 2 * k + 1], X[0, z + 2 * k2], X[0, z + 2 * k2 + 1]
        er, ei, dr, di = half * (ar + br), half * (ai - bi), half * (ai + bi), half * (br - ar)
        w = T[0, turns + k]
        tr, tj = dr * w[0] - di * w[1], dr * w[1] + di * w[0]
        X[0, o + 2 * k1], X[0, o + 2 * k1 + 1] = er - tr, tj - ei
        X[0, o + 2 * k], X[0, o + 2 * k + 1] = er + tr, ei + tj


@ti.func
def merge(X: ti.template(), o, z, T: ti.template(), C: ti.template(), c):
    """The inverse of :func:`split`."""
    half, m, turns = ti.cast(0.5, X.dtype), C[c, M], C[c, SPLIT]
    for k in range(m // 2 + 1):
        k1, k2 = m - k, (m - k) % m
        pr, pi, qr, qi = X[0, o + 2 * k], X[0, o + 2 * k + 1], X[0, o + 2 * k1], X[0, o + 2 * k1 + 1]
        er, ei, dr, di = half * (pr + qr), half * (pi - qi), half * (pr - qr), half * (pi + qi)
        w = T[0, turns + k]
        tr, tj = dr * w[0] + di * w[1], di * w[0] - dr * w[1]
        X[0, z + 2 * k2], X[0, z + 2 * k2 + 1] = er + tj, tr - ei
        X[0, z + 2 * k], X[0, z + 2 * k + 1] = er - tj, ei + tr


@ti.func
def scatter(X: ti.template(), o, Y: ti.template(), C: ti.template(), c, s):
    """Spectra of block s, lanes of rows, to lanes of waves."""
    step = C[c, STEP]
    first = C[c, SPECTRA] + s * W * step
    for g in range(C[c, GROUPS]):
        q, to = o + 2 * g * GROUP, first + 2 * g
        for p in ti.static(range(2)):
            rows = [X[0, q + 2 * t + p] for t in ti.static(range(GROUP))]
            for u in ti.static(range(W)):
                Y[0, to + p + u * step] = ti.Vector([rows[t][u] for t in ti.static(range(GROUP))])


@ti.func
def gather(Y: ti.template(), X: ti.template(), o, C: ti.template(), c, s):
    """And back."""
    step = C[c, STEP]
    first = C[c, SPECTRA] + s * W * step
    for g in range(C[c, GROUPS]):
        q, source = o + 2 * g * GROUP, first + 2 * g
        for p in ti.static(range(2)):
            rows = [Y[0, source + p + u * step] for u in ti.static(range(W))]
            for t in ti.static(range(GROUP)):
                X[0, q + 2 * t + p] = ti.Vector([rows[u][t] for u in ti.static(range(W))])


@ti.func
def rows_of_worker(C: ti.template(), w):
    """First entry of the rows that worker w transforms."""
    return C[0, WORK_X] + 2 * w * C[0, SIZE_X]


@ti.func
def along_x(X: ti.template(), Y: ti.template(), T: ti.template(), Q: ti.template(), C: ti.template(), c, s, w, back):
    """Transform of block s, whose rows worker w has in X: to the spectra, or from them with back = 1. Returns the first entry
    of the rows then."""
    a, size = rows_of_worker(C, w), C[c, SIZE_X]
    z = a
    if back == 1:
        gather(Y, X, a, C, c, s)
        z = a + size
        merge(X, a, z, T, C, c)
    z = transform(X, z, other(z, a, size), T, Q, C[c, X_ROW], C[c, X_ROWS], back)
    if back == 0:
        o = other(z, a, size)
        split(X, z, o, T, C, c)
        scatter(X, o, Y, C, c, s)
    return z


@ti.func
def load_waves(Y: ti.template(), C: ti.template(), c, e, a):
    """Group of waves from entry e of the spectra to the buffer at a, less an endless outermost row, zero behind."""
    ny, step = C[c, NY], C[c, STEP]
    rest = ti.cast(C[c, ENDLESS], Y.dtype)
    lr, li = rest * Y[0, e + ny * step], rest * Y[0, e + ny * step + 1]
    for j in range(ny + 1):
        Y[0, a + 2 * j], Y[0, a + 2 * j + 1] = Y[0, e + j * step] - lr, Y[0, e + j * step + 1] - li
    zero = ti.Vector([ti.cast(0.0, Y.dtype) for _ in ti.static(range(GROUP))])
    for j in range(ny + 1, C[c, N]):
        Y[0, a + 2 * j], Y[0, a + 2 * j + 1] = zero, zero
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
    """And back to the spectra, plus the answer of the strip to the outermost row."""
    ny, step, strip = C[c, NY], C[c, STEP], Y[0, C[c, STRIP] + g]
    lr, li = strip * Y[0, e + ny * step], strip * Y[0, e + ny * step + 1]
    for j in range(ny + 1):
        Y[0, e + j * step], Y[0, e + j * step + 1] = Y[0, z + 2 * j] + lr, Y[0, z + 2 * j + 1] + li


@ti.func
def along_y(Y: ti.template(), T: ti.template(), Q: ti.template(), C: ti.template(), c, g, w):
    """Multiply group g of waves by the symbol, with the buffers of worker w."""
    e, size = C[c, SPECTRA] + 2 * g, C[c, SIZE_Y]
    start = C[c, WORK_Y] + 2 * w * size
    if C[c, NY] == 0:
        strip = Y[0, C[c, STRIP] + g]
        Y[0, e], Y[0, e + 1] = strip * Y[0, e], strip * Y[0, e + 1]
    else:
        load_waves(Y, C, c, e, start)
        z = start
        for back in range(2):
            z = transform(Y, z, other(z, start, size), T, Q, C[c, Y_ROW], C[c, Y_ROWS], back)
            if back == 0:
                multiply(Y, z, C, c, g)
        store_waves(Y, z, C, c, e, g)
