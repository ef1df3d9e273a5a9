"""Complex Fourier transforms with one thread per butterfly: Stockham's passes of :mod:`tehl_taichi.engine.fft`.

Numbers are vectors (real, imaginary part) in a field of two rows; each pass reads one row and writes the other.
"""

import math

from tehl_taichi.engine.language import ti


class Pass:
    """One pass of transforms, from row `source` of the field to the other row.

    radix, parts, stride: their product is the length; turns: first of its factors in the table.
    """

    def __init__(self, radix, parts, stride, turns, source):
        self.radix, self.parts, self.stride, self.turns, self.source = radix, parts, stride, turns, source
        self.distance = parts * stride  # between inputs of a butterfly; also the number of butterflies


def passes(lengths, n, source):
    """List of passes for the length n; lengths: :class:`tehl_taichi.engine.fft.Lengths` with its factors; source: first row."""
    first, count = lengths.place(n)
    return [Pass(*lengths.passes[first + m], (source + m) % 2) for m in range(count)]


@ti.func
def turned(z, c, s):
    """z (c + i s)."""
    return ti.Vector([z[0] * c - z[1] * s, z[0] * s + z[1] * c])


@ti.func
def times_i(z, sense):
    """i z, or -i z if sense is -1."""
    return ti.Vector([-sense * z[1], sense * z[0]])


@ti.func
def sum_of_turned(B: ti.template(), x: ti.template(), r: ti.template(), radix: ti.template(), sense):
    """Result r of a butterfly of an odd radix from its inputs."""
    out = x[0]
    for m in ti.static(range(1, radix)):
        angle = ti.static(2 * math.pi * (r * m % radix) / radix)
        out += turned(x[m], ti.cast(ti.static(math.cos(angle)), B.dtype),
                      -sense * ti.cast(ti.static(math.sin(angle)), B.dtype))
    return out


@ti.func
def butterfly(B: ti.template(), T: ti.template(), one: ti.template(), t, first, pitch, backward: ti.template()):
    """Butterfly t of the pass `one` on the numbers at first, first + pitch, ...; backward: exp(+i ...), without 1/n."""
    sense = ti.cast(ti.static(-1.0 if backward else 1.0), B.dtype)
    x = [B[one.source, first + pitch * (t + m * one.distance)] for m in ti.static(range(one.radix))]
    p = t // one.stride
    o, to = t % one.stride + one.radix * one.stride * p, ti.static(1 - one.source)
    if ti.static(one.radix == 4):
        a, b, c, d = x[0] + x[2], x[0] - x[2], x[1] + x[3], times_i(x[1] - x[3], -sense)
        B[to, first + pitch * o] = a + c
        store(B, T, one, p, 1, first + pitch * (o + one.stride), b + d, sense)
        store(B, T, one, p, 2, first + pitch * (o + 2 * one.stride), a - c, sense)
        store(B, T, one, p, 3, first + pitch * (o + 3 * one.stride), b - d, sense)
    elif ti.static(one.radix == 2):
        B[to, first + pitch * o] = x[0] + x[1]
        store(B, T, one, p, 1, first + pitch * (o + one.stride), x[0] - x[1], sense)
    else:
        B[to, first + pitch * o] = sum_of_turned(B, x, 0, one.radix, sense)
        for r in ti.static(range(1, one.radix)):
            store(B, T, one, p, r, first + pitch * (o + r * one.stride), sum_of_turned(B, x, r, one.radix, sense), sense)


@ti.func
def store(B: ti.template(), T: ti.template(), one: ti.template(), p, r: ti.template(), where, z, sense):
    """Store result r of part p of a pass, times its factor."""
    w = T[0, one.turns + ti.static(one.radix - 1) * p + ti.static(r - 1)]
    B[ti.static(1 - one.source), where] = turned(z, w[0], sense * w[1])
