"""The deflection K and the distribution K^-1 with one butterfly per thread; mathematics:
:mod:`tehl_taichi.pressure.linear.convolution`.

Along x: complex transforms of length M of the even (real part) and odd (imaginary part) columns, split into waves 0 ... M.
Along y: complex transforms of length N of all waves. Several convolutions run together: one loop does a pass of each.
"""

import numpy as np

from tehl_taichi.engine import field_pool, simd
from tehl_taichi.engine.fft import Lengths
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import W
from tehl_taichi.pressure.linear.cells.sizes import Jobs, Level
from tehl_taichi.pressure.linear.cells.transforms import butterfly, passes, turned


class Convolution:
    """Places of one convolution.

    M, N: lengths along x and y. x, y: first entries of the rows and of the waves. symbol, strip, split: first entries of their
    tables. last: first entry of the waves of the pressure beyond. half_first, half_last: rows on a mirror, which count half, or
    -1. along, across, back: passes of the transforms.
    """

    def __init__(self, levels, symbols, lengths, at):
        shape = symbols.shape
        self.symbols, self.level, self.M, self.N, self.ny = symbols, Level(levels, shape.level), shape.M, shape.N, shape.ny
        self.rows, self.waves, self.half_waves = shape.ny + 1, shape.M + 1, shape.N // 2 + 1
        self.x, self.y, self.symbol, self.last = at["x"], at["y"], at["symbol"], at["last"]
        self.strip = self.symbol + self.half_waves * self.waves
        self.split = lengths.turns(np.arange(self.M + 1), 2 * self.M)
        self.along, self.across = passes(lengths, self.M, 0), passes(lengths, self.N, 0)
        self.back = passes(lengths, self.N, len(self.across) % 2)
        self.there, self.here = len(self.along) % 2, len(self.across) % 2  # rows of X, Y that hold the results
        self.half_first, self.half_last = 0 if symbols.mirrors[0] else -1, self.ny if symbols.mirrors[1] else -1
        self.endless = bool(symbols.endless)
        for name, count in (("x", self.rows * self.M), ("y", self.N * self.waves), ("last", self.waves),
                            ("symbol", (self.half_waves + 1) * self.waves)):
            at[name] += count

    def entries(self):
        """Numbers (n, 3): A, Re B, Im B of each wave, then the strip; with the factors 1/M, 1/N of the transforms."""
        s, out = self.symbols, np.zeros((self.half_waves + 1, self.waves, 3))
        out[:-1] = np.stack([s.A, s.B.real, s.B.imag], axis=2) / (self.M * self.N)
        out[-1, :, 0] = s.strip / self.M
        return out.reshape(-1, 3)


class Convolutions:
    """Several convolutions that run together; symbols: of each convolution.

    Fields: X (rows), Y (waves), T (twiddle factors), A (symbols), E (waves of the pressure beyond). Further attributes are the
    Jobs of the loops.
    """

    def __init__(self, levels, symbols, precision, dtype):
        lengths, at = Lengths(), dict(x=0, y=0, symbol=0, last=0)
        self.all = [Convolution(levels, one, lengths, at) for one in symbols]
        twiddles = lengths.twiddles()
        sizes = dict(X=(2, 2, at["x"]), Y=(2, 2, at["y"]), T=(1, 2, len(twiddles)), A=(1, 3, at["symbol"]),
                     E=(1, 2, at["last"]))
        for name, (rows, lanes, size) in sizes.items():
            setattr(self, name, field_pool.lease(self, rows, lanes, size, precision=precision, clean=False))
        simd.fill(*simd.one_of((self.T, self.A), self.T), 0, 0, twiddles.astype(dtype))
        simd.fill(*simd.one_of((self.T, self.A), self.A), 0, 0, np.concatenate([c.entries() for c in self.all]).astype(dtype))
        self._count()

    def _count(self):
        """Set the jobs of the loops."""
        self.along = self._passes([(c, c.along, c.rows) for c in self.all])
        self.across = self._passes([(c, c.across, c.waves) for c in self.all])
        self.back = self._passes([(c, c.back, c.waves) for c in self.all])
        self.columns = Jobs([(c, c.level.blocks * c.M) for c in self.all])  # pairs of columns
        self.spread = Jobs([(c, c.N * c.waves) for c in self.all])
        self.pairs = Jobs([(c, c.half_waves * c.waves) for c in self.all])
        self.joined = Jobs([(c, c.rows * c.M) for c in self.all])

    @staticmethod
    def _passes(parts):
        """List of the Jobs of each pass; parts: (convolution, its passes, number of its transforms)."""
        most = max(len(passes_of) for _, passes_of, _ in parts)
        return [Jobs([((c, ps[n]), together * ps[n].distance) for c, ps, together in parts if n < len(ps)])
                for n in range(most)]


@ti.func
def put_pair(K: ti.template(), c: ti.template(), s, m, even, odd):
    """Write columns 2 m and 2 m + 1 of block s to X."""
    for u in ti.static(range(W)):
        if s * W + u <= c.ny:
            K.X[0, c.x + (s * W + u) * c.M + m] = ti.Vector([even[u], odd[u]])


@ti.func
def column(K: ti.template(), c: ti.template(), s, i):
    """Column i of block s of the result; 0 in ghosts."""
    out, m = ti.Vector([ti.cast(0.0, K.X.dtype) for _ in ti.static(range(W))]), i // 2 % c.M
    for u in ti.static(range(W)):
        if s * W + u <= c.ny:
            z = K.X[c.there, c.x + (s * W + u) * c.M + m]
            out[u] = ti.select(i % 2 == 0, z[0], z[1])
    return out


@ti.func
def pass_along(K: ti.template(), n: ti.template(), backward: ti.template()):
    """Pass n of the transforms along x of all convolutions."""
    for t in range(K.along[n].total):
        for part, first, end in ti.static(K.along[n].parts):
            c, one = ti.static(part)
            if first <= t < end:
                row, b = (t - first) // one.distance, (t - first) % one.distance
                butterfly(K.X, K.T, one, b, c.x + row * c.M, 1, backward)


@ti.func
def pass_across(K: ti.template(), jobs: ti.template(), backward: ti.template()):
    """One pass of the transforms along y of all convolutions."""
    for t in range(jobs.total):
        for part, first, end in ti.static(jobs.parts):
            c, one = ti.static(part)
            if first <= t < end:
                butterfly(K.Y, K.T, one, (t - first) // c.waves, c.y + (t - first) % c.waves, c.waves, backward)


@ti.func
def wave(K: ti.template(), c: ti.template(), j, k):
    """Wave k of the real transform of row j, from the complex transform."""
    half, row = ti.cast(0.5, K.X.dtype), c.x + j * c.M
    a, b, w = K.X[c.there, row + k % c.M], K.X[c.there, row + (c.M - k) % c.M], K.T[0, c.split + k]
    even = half * ti.Vector([a[0] + b[0], a[1] - b[1]])
    return even + turned(half * ti.Vector([a[1] + b[1], b[0] - a[0]]), w[0], w[1])


@ti.func
def beyond(K: ti.template(), c: ti.template(), k):
    """Wave k of the pressure beyond the grid: of the outermost row, of a whole domain of the mean of both."""
    last = wave(K, c, c.ny, k)
    if ti.static(c.half_first != 0):  # the first row lies on no mirror
        last = ti.cast(0.5, K.X.dtype) * (last + wave(K, c, 0, k))
    return last


@ti.func
def spread(K: ti.template()):
    """Write the waves of all rows to Y: an endless pressure :func:`beyond` is subtracted, rows on a mirror count half, further
    entries are zero."""
    for t in range(K.spread.total):
        for c, first, end in ti.static(K.spread.parts):
            if first <= t < end:
                j, k = (t - first) // c.waves, (t - first) % c.waves
                z = ti.Vector([ti.cast(0.0, K.X.dtype), ti.cast(0.0, K.X.dtype)])
                if j <= c.ny:
                    z = wave(K, c, j, k)
                    if j == c.ny:
                        K.E[0, c.last + k] = beyond(K, c, k)
                    if ti.static(c.endless):
                        z -= beyond(K, c, k)
                    if j == c.half_first or j == c.half_last:
                        z = ti.cast(0.5, K.X.dtype) * z
                K.Y[0, c.y + t - first] = z


@ti.func
def multiply(K: ti.template()):
    """Y(n) = A(n) X(n) + B(n) X(-n), in place."""
    for t in range(K.pairs.total):
        for c, first, end in ti.static(K.pairs.parts):
            if first <= t < end:
                n, k = (t - first) // c.waves, (t - first) % c.waves
                one, other = c.y + n * c.waves + k, c.y + (c.N - n) % c.N * c.waves + k
                p, q, symbol = K.Y[c.here, one], K.Y[c.here, other], K.A[0, c.symbol + t - first]
                K.Y[c.here, other] = symbol[0] * q + turned(p, symbol[1], -symbol[2])
                K.Y[c.here, one] = symbol[0] * p + turned(q, symbol[1], symbol[2])


@ti.func
def answer(K: ti.template(), c: ti.template(), j, k):
    """Wave k of row j, with the response of the strip to the pressure beyond."""
    return K.Y[0, c.y + j * c.waves + k] + K.A[0, c.strip + k][0] * K.E[0, c.last + k]


@ti.func
def join(K: ti.template()):
    """Complex transforms along x from the waves: the inverse of :func:`wave`."""
    for t in range(K.joined.total):
        for c, first, end in ti.static(K.joined.parts):
            if first <= t < end:
                j, k = (t - first) // c.M, (t - first) % c.M
                half, w = ti.cast(0.5, K.X.dtype), K.T[0, c.split + k]
                p, q = half * answer(K, c, j, k), half * answer(K, c, j, c.M - k)
                turn = turned(ti.Vector([p[0] - q[0], p[1] + q[1]]), w[0], -w[1])
                K.X[0, c.x + t - first] = ti.Vector([p[0] + q[0] - turn[1], p[1] - q[1] + turn[0]])


@ti.func
def convolve(K: ti.template()):
    """Convolve the columns that :func:`put_pair` has written; :func:`column` reads the result."""
    for n in ti.static(range(len(K.along))):
        pass_along(K, n, False)
    spread(K)
    for n in ti.static(range(len(K.across))):
        pass_across(K, K.across[n], False)
    multiply(K)
    for n in ti.static(range(len(K.back))):
        pass_across(K, K.back[n], True)
    join(K)
    for n in ti.static(range(len(K.along))):
        pass_along(K, n, True)
