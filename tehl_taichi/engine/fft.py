"""Complex Fourier transforms inside kernels: lengths with factors 2, 3 and 5, known at run time; lanes are transformed
together.

Stockham's passes (radix 4, 2, 3, 5) between two buffers of a field of vectors; number k of a transform is in the entries 2 k
and 2 k + 1 (real, imaginary part). It is a field, not an array, because loops over arrays do not become vector instructions
(0.225 against 0.060 ms for 65 rows of 512).
"""

import math

import numpy as np

from tehl_taichi.engine.language import ti

RADIX, PARTS, STRIDE, FACTORS = range(4)  # columns of a table of passes

Passes = ti.types.ndarray(dtype=ti.i32, ndim=2)


def odd_radices(*lengths):
    """Odd radices of the passes of all these :class:`Lengths`; others are not compiled."""
    return tuple(sorted({code for one in lengths for code, *_ in one.passes if code % 2}))


def fast_length(n):
    """Smallest length >= n with no prime factors other than 2, 3 and 5."""
    while _rest(n) > 1:
        n += 1
    return n


def _rest(n):
    for p in (2, 3, 5):
        while n % p == 0:
            n //= p
    return n


def radices(n):
    """Radices of the passes for length n, those of 4 last."""
    found = []
    for p in (5, 3):
        while n % p == 0:
            found.append(p)
            n //= p
    twos = n.bit_length() - 1
    return found + [2] * (twos % 2) + [4] * (twos // 2)


class Lengths:
    """Tables of passes and of twiddle factors for all lengths requested."""

    def __init__(self):
        self.passes, self.factors, self.known = [], [], {}

    def place(self, n):
        """(first row, number of rows) of the passes of length n in :meth:`table`."""
        if n not in self.known:
            first = len(self.passes)
            self._add(n)
            self.known[n] = first, len(self.passes) - first
        return self.known[n]

    def _add(self, n):
        stride, parts = 1, n
        for radix in radices(n):
            parts //= radix
            self.passes.append((radix, parts, stride, self.turns(np.outer(np.arange(parts), np.arange(1, radix)).ravel(),
                                                                radix * parts)))
            stride *= radix

    def turns(self, steps, n):
        """Position of the factors exp(-2 pi i steps / n) among the twiddle factors; they are added if missing."""
        first = sum(map(len, self.factors))
        angles = 2 * np.pi * (steps % n) / n
        self.factors.append(np.stack([np.cos(angles), -np.sin(angles)], 1))
        return first

    def table(self):
        """The passes of all lengths, int32 (rows, 4), at least one row."""
        return np.array(self.passes or [(1, 1, 1, 0)], np.int32)

    def twiddles(self):
        """All twiddle factors (count, 2), double precision."""
        return np.concatenate([*self.factors, np.zeros((1, 2))])


@ti.func
def turned(re, im, c, s):
    return re * c - im * s, re * s + im * c


@ti.func
def pass_2(B: ti.template(), a, b, T: ti.template(), t, parts, stride, sense):
    d, e = 2 * parts * stride, 2 * stride
    for p in range(parts):
        w = T[0, t + p]
        s = sense * w[1]
        for q in range(stride):
            i, o = a + 2 * (q + stride * p), b + 2 * (q + 2 * stride * p)
            xr, xi, yr, yi = B[0, i], B[0, i + 1], B[0, i + d], B[0, i + d + 1]
            zr, zi = turned(xr - yr, xi - yi, w[0], s)
            B[0, o], B[0, o + 1] = xr + yr, xi + yi
            B[0, o + e], B[0, o + e + 1] = zr, zi


@ti.func
def pass_4(B: ti.template(), a, b, T: ti.template(), t, parts, stride, sense):
    d, e = 2 * parts * stride, 2 * stride
    for p in range(parts):
        w1, w2, w3 = T[0, t + 3 * p], T[0, t + 3 * p + 1], T[0, t + 3 * p + 2]
        s1, s2, s3 = sense * w1[1], sense * w2[1], sense * w3[1]
        for q in range(stride):
            i, o = a + 2 * (q + stride * p), b + 2 * (q + 4 * stride * p)
            x0r, x0i, x1r, x1i = B[0, i], B[0, i + 1], B[0, i + d], B[0, i + d + 1]
            x2r, x2i, x3r, x3i = B[0, i + 2 * d], B[0, i + 2 * d + 1], B[0, i + 3 * d], B[0, i + 3 * d + 1]
            ar, ai, br, bi = x0r + x2r, x0i + x2i, x0r - x2r, x0i - x2i
            cr, ci, dr, di = x1r + x3r, x1i + x3i, sense * (x1i - x3i), sense * (x3r - x1r)
            y1r, y1i = turned(br + dr, bi + di, w1[0], s1)
            y2r, y2i = turned(ar - cr, ai - ci, w2[0], s2)
            y3r, y3i = turned(br - dr, bi - di, w3[0], s3)
            B[0, o], B[0, o + 1] = ar + cr, ai + ci
            B[0, o + e], B[0, o + e + 1] = y1r, y1i
            B[0, o + 2 * e], B[0, o + 2 * e + 1] = y2r, y2i
            B[0, o + 3 * e], B[0, o + 3 * e + 1] = y3r, y3i


@ti.func
def part(B: ti.template(), i, d, radix: ti.template(), r: ti.template()):
    """Sums and differences of the inputs r and radix - r of an odd radix: (re, im) of both."""
    m = ti.static(radix - r)
    xr, xi, yr, yi = B[0, i + r * d], B[0, i + r * d + 1], B[0, i + m * d], B[0, i + m * d + 1]
    return xr + yr, xi + yi, xr - yr, xi - yi


@ti.func
def cosine(B: ti.template(), radix: ti.template(), n: ti.template()):
    return ti.cast(ti.static(math.cos(2 * math.pi * n / radix)), B.dtype)


@ti.func
def sine(B: ti.template(), radix: ti.template(), n: ti.template()):
    return ti.cast(ti.static(math.sin(2 * math.pi * n / radix)), B.dtype)


@ti.func
def pass_odd(B: ti.template(), a, b, T: ti.template(), t, parts, stride, sense, radix: ti.template()):
    """Pass of radix 3 or 5: results r and radix - r from the same sums (with 3 the second pair of inputs has no weight)."""
    d, e = 2 * parts * stride, 2 * stride
    for p in range(parts):
        for q in range(stride):
            i, o = a + 2 * (q + stride * p), b + 2 * (q + radix * stride * p)
            zr, zi = B[0, i], B[0, i + 1]
            s1r, s1i, d1r, d1i = part(B, i, d, radix, 1)
            s2r, s2i, d2r, d2i = part(B, i, d, radix, ti.static(radix // 2))
            for r in ti.static(range(1, radix // 2 + 1)):
                fr, fi = zr + cosine(B, radix, r) * s1r, zi + cosine(B, radix, r) * s1i
                gr, gi = sine(B, radix, r) * d1i, -sine(B, radix, r) * d1r
                if ti.static(radix == 5):
                    fr, fi = fr + cosine(B, radix, 2 * r) * s2r, fi + cosine(B, radix, 2 * r) * s2i
                    gr, gi = gr + sine(B, radix, 2 * r) * d2i, gi - sine(B, radix, 2 * r) * d2r
                gr, gi = sense * gr, sense * gi
                v, w = T[0, t + ti.static(radix - 1) * p + r - 1], T[0, t + ti.static(radix - 1) * p + ti.static(radix - r) - 1]
                B[0, o + r * e], B[0, o + r * e + 1] = turned(fr + gr, fi + gi, v[0], sense * v[1])
                B[0, o + ti.static(radix - r) * e], B[0, o + ti.static(radix - r) * e + 1] = turned(fr - gr, fi - gi, w[0],
                                                                                                   sense * w[1])
            if ti.static(radix == 5):
                zr, zi = zr + s2r, zi + s2i
            B[0, o], B[0, o + 1] = zr + s1r, zi + s1i


@ti.func
def transform(B: ti.template(), first, second, T: ti.template(), Q: ti.template(), odd: ti.template(), row, rows, backward):
    """Transform of the numbers from entry `first` of B[0, :], with `second` as the other buffer; Q[row ...] are its passes.

    odd: the odd radices among all passes of Q, see :func:`odd_radices`; backward: 1 for exp(+i ...); no factor 1/n either way.
    Returns the first entry of the result: `first` or `second`.
    """
    a, b, sense = first, second, ti.cast(1 - 2 * backward, B.dtype)
    for n in range(row, row + rows):
        code, parts, stride, t = Q[n, RADIX], Q[n, PARTS], Q[n, STRIDE], Q[n, FACTORS]
        if code == 4:
            pass_4(B, a, b, T, t, parts, stride, sense)
        elif code == 2:
            pass_2(B, a, b, T, t, parts, stride, sense)
        for radix in ti.static(odd):
            if code == radix:
                pass_odd(B, a, b, T, t, parts, stride, sense, radix)
        a, b = b, a
    return a
