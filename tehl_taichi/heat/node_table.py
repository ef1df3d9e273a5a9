"""Node numbers across the film for kernels: table N of :class:`tehl_taichi.heat.chebyshev.ChebyshevNodes`."""

from tehl_taichi.engine.language import ti
from tehl_taichi.heat.chebyshev import BEYOND, INTEGRAL, MATRICES, SECOND, SLOPE, WEIGHT, ZETA

Nodes = ti.types.ndarray(dtype=ti.f64, ndim=2)


@ti.func
def zeta(N: ti.template(), n):
    """Position of node n."""
    return N[ZETA, n]


@ti.func
def weight(N: ti.template(), n):
    """Weight of node n in int_0^1 dzeta."""
    return N[WEIGHT, n]


@ti.func
def entry(N: ti.template(), matrix: ti.template(), n, m):
    return N[MATRICES + matrix * N.shape[1] + n, m]


@ti.func
def integral(N: ti.template(), n, m):
    """Weight of node m in the integral from 0 to node n."""
    return entry(N, INTEGRAL, n, m)


@ti.func
def slope(N: ti.template(), n, m):
    """Weight of node m in d/dzeta at node n."""
    return entry(N, SLOPE, n, m)


@ti.func
def second(N: ti.template(), n, m):
    """Weight of node m in d2/dzeta2 at node n."""
    return entry(N, SECOND, n, m)


@ti.func
def beyond(N: ti.template(), m, n):
    """Weight of node n in the integral from node m to 1."""
    return entry(N, BEYOND, n, m)
