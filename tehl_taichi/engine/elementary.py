"""exp, log, minimum and maximum for numbers and for lanes.

On lanes (a vector of rows) the library calls one row at a time and takes most of the time of the laws. These work on all rows
at once: range reduction by powers of two, then a polynomial (Hart, Computer Approximations, 1968), to 4e-16, summed by Estrin's
scheme (Horner's is one long chain, for which loops over nodes would wait; laws of a film 1.5 times slower).

Taichi's min and max return a number if the other argument is NaN: three instructions in the chain of each exp. A choice between
two is one instruction (laws of a film 2.9 -> 2.2 ms per call, 256x64x9); if one is NaN, it returns the second argument.
"""

import numbers

from tehl_taichi.engine import runtime
from tehl_taichi.engine.language import ti

LOG2E = 1.4426950408889634
LN2_HIGH, LN2_LOW = 0.693147180369123816490, 1.90821492927058770002e-10
SHIFT = 6755399441055744.0  # 1.5 * 2^52: adding it leaves the rounded number in the lowest bits
EXP_TERMS = tuple(1.0 / f for f in (1.0, 1.0, 2.0, 6.0, 24.0, 120.0, 720.0, 5040.0, 40320.0, 362880.0, 3628800.0, 39916800.0,
                                    479001600.0, 6227020800.0))
LOG_TERMS = tuple(2.0 / n for n in (1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21))
MANTISSA, ONE, TWO52 = 0x000FFFFFFFFFFFFF, 0x3FF0000000000000, 0x4330000000000000


@ti.pyfunc
def minimum(a, b):
    return ti.select(a < b, a, b)


@ti.pyfunc
def maximum(a, b):
    return ti.select(a > b, a, b)


def _without_library(x):
    """Whether there is no function of double precision for this value of a kernel: Vulkan has none."""
    return runtime.chosen() == "vulkan" and not isinstance(x, numbers.Number)


@ti.func
def exp_lanes(x):
    x = minimum(maximum(x, -700.0), 700.0)
    shifted = x * LOG2E + SHIFT
    n = shifted - SHIFT
    if ti.static(_without_library(x)):  # and a compiler that takes n for x LOG2E
        n = ti.floor(x * LOG2E + 0.5)
    r = (x - n * LN2_HIGH) - n * LN2_LOW
    r2 = r * r
    r4 = r2 * r2
    c = ti.static(EXP_TERMS)
    low = ((c[0] + c[1] * r) + (c[2] + c[3] * r) * r2) + ((c[4] + c[5] * r) + (c[6] + c[7] * r) * r2) * r4
    high = ((c[8] + c[9] * r) + (c[10] + c[11] * r) * r2) + (c[12] + c[13] * r) * r4
    out = low + high * (r4 * r4)
    for u in ti.static(range(x.n)):
        power = ti.bit_cast(shifted[u], ti.i64)
        if ti.static(_without_library(x)):
            power = ti.cast(n[u], ti.i64)
        out[u] = ti.bit_cast(ti.bit_cast(out[u], ti.i64) + (power << 52), ti.f64)
    return out


@ti.func
def log_lanes(x):
    """Natural logarithm of positive, normal numbers."""
    m, e = x, x
    for u in ti.static(range(x.n)):
        bits = ti.bit_cast(x[u], ti.i64)
        m[u] = ti.bit_cast((bits & ti.i64(MANTISSA)) | ti.i64(ONE), ti.f64)
        e[u] = ti.bit_cast((bits >> 52) | ti.i64(TWO52), ti.f64) - 4503599627370496.0 - 1023.0
    big = m > 1.4142135623730951
    m, e = ti.select(big, 0.5 * m, m), ti.select(big, e + 1.0, e)
    f = (m - 1.0) / (m + 1.0)
    f2 = f * f
    f4 = f2 * f2
    f8 = f4 * f4
    c = ti.static(LOG_TERMS)
    low = ((c[0] + c[1] * f2) + (c[2] + c[3] * f2) * f4) + ((c[4] + c[5] * f2) + (c[6] + c[7] * f2) * f4) * f8
    out = low + ((c[8] + c[9] * f2) + c[10] * f4) * (f8 * f8)
    return out * f + (e * LN2_HIGH + e * LN2_LOW)


@ti.func
def root(x, power: ti.template()):
    """x^(1/power) of positive lanes, by the library where there is one."""
    out = x
    if ti.static(_without_library(x)):
        out = exp_lanes(log_lanes(x) / power)
    else:
        out = ti.exp(ti.log(x) / power)
    return out


@ti.func
def within(value, a, b):
    """`value` limited to the range between a and b."""
    return minimum(maximum(value, minimum(a, b)), maximum(a, b))


def _lanes(x):
    return hasattr(x, "is_tensor") and x.is_tensor()


@ti.pyfunc
def exp(x):
    out = x
    if ti.static(_lanes(x)):
        out = exp_lanes(x)
    elif ti.static(_without_library(x)):
        out = exp_lanes(ti.Vector([x]))[0]
    else:
        out = ti.exp(x)
    return out


@ti.pyfunc
def log(x):
    out = x
    if ti.static(_lanes(x)):
        out = log_lanes(x)
    elif ti.static(_without_library(x)):
        out = log_lanes(ti.Vector([x]))[0]
    else:
        out = ti.log(x)
    return out
