"""dP/dX and dP/dY at the nodes, from the differences to both neighbours."""

from tehl_taichi.engine.lanes import V, W, above, below
from tehl_taichi.engine.language import ti
from tehl_taichi.pressure.fields import DX, DY, P


@ti.func
def along_x(S: ti.template(), at: ti.template()):
    """Differences of P behind and ahead; in the border columns twice the one that exists."""
    behind, ahead = S[P, at.k - ti.min(at.i, 1)], S[P, at.k + ti.min(at.nx - at.i, 1)]
    here = S[P, at.k]
    return ti.select(at.i > 0, here - behind, ahead - here), ti.select(at.i < at.nx, ahead - here, here - behind)


@ti.func
def along_y(S: ti.template(), at: ti.template()):
    """The same across; none in the first and the last row: a plane of symmetry, and the edge where nothing changes any more."""
    here, n2 = S[P, at.k], at.nx + 1
    below_it, above_it = here - below(S, P, at.k, n2), above(S, P, at.k, n2) - here
    for u in ti.static(range(W)):
        if at.s * W + u == 0 or at.s * W + u >= at.ny:
            below_it[u], above_it[u] = 0.0, 0.0
    return below_it, above_it


@ti.func
def central_gradient(S: ti.template(), G: ti.template(), at: ti.template()):
    """For tractions. at: the :class:`Place` of the nodes."""
    behind, ahead = along_x(S, at)
    below_it, above_it = along_y(S, at)
    return 0.5 * (behind + ahead) / G[0, DX], 0.5 * (below_it + above_it) / G[0, DY]


@ti.func
def limited_gradient(S: ti.template(), G: ti.template(), at: ti.template()):
    """For velocities and heat: central differences at the cavitation edge heat by hundreds of K. None where P = 0."""
    x, y, wet = limited(*along_x(S, at)) / G[0, DX], V(0.0), S[P, at.k] > 0.0
    if at.ny > 0:
        y = limited(*along_y(S, at)) / G[0, DY]
    return ti.select(wet, x, V(0.0)), ti.select(wet, y, V(0.0))


@ti.func
def limited(a, b):
    """Central difference of two one-sided ones, at most twice the smaller, 0 where they differ in sign (van Leer 1977). His
    harmonic mean would be wrong by a quarter beside every plane of symmetry."""
    size = ti.min(2.0 * ti.min(ti.abs(a), ti.abs(b)), 0.5 * ti.abs(a + b))
    return ti.select(a * b > 0.0, ti.select(a > 0.0, size, -size), V(0.0))
