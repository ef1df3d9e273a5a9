"""dP/dX and dP/dY at the nodes, from the differences to both neighbours."""

from tehl_taichi.engine.elementary import within
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import V, W, above, below
from tehl_taichi.pressure.fields import DX, DY, P
from tehl_taichi.pressure.fluxes import flux, flux_x, mobility, node


@ti.func
def along_x(S: ti.template(), at: ti.template()):
    """Differences of P behind and ahead; in the border columns twice the existing one."""
    behind, ahead = S[P, at.k - ti.min(at.i, 1)], S[P, at.k + ti.min(at.nx - at.i, 1)]
    here = S[P, at.k]
    return ti.select(at.i > 0, here - behind, ahead - here), ti.select(at.i < at.nx, ahead - here, here - behind)


@ti.func
def along_y(S: ti.template(), at: ti.template()):
    """Differences along y; zero beyond the first row (plane of symmetry) and the last row (constant edge)."""
    here, n2 = S[P, at.k], at.nx + 1
    below_it, above_it = here - below(S, P, at.k, n2), above(S, P, at.k, n2) - here
    for u in ti.static(range(W)):
        if at.s * W + u == 0 or at.s * W + u >= at.ny:
            below_it[u], above_it[u] = 0.0, 0.0
    return below_it, above_it


@ti.func
def central_gradient(S: ti.template(), G: ti.template(), at: ti.template()):
    """Central gradient of the pressure, for tractions. at: the :class:`LaneBlock` of the nodes."""
    behind, ahead = along_x(S, at)
    below_it, above_it = along_y(S, at)
    return 0.5 * (behind + ahead) / G[0, DX], 0.5 * (below_it + above_it) / G[0, DY]


@ti.func
def limited_gradient(S: ti.template(), G: ti.template(), at: ti.template()):
    """Limited gradient for velocities and heat (central ones heat the cavitation edge by hundreds of K); 0 if P = 0.

    It is at most the gradient that drives the fluxes of the Reynolds equation with the node's own viscosity. Between thin and
    thick oil nearly the whole difference is needed in the thick one; if it acted in both, a fall of 1 GPa within a cell would
    heat the hot band of a cold film at the outlet by 100 K in a step, and columns would have no solution. Gear at SRR -0.5,
    central film on 128 / 256 / 512 / 1024 columns: with this bound 0.3819, 0.3827, 0.3829, 0.3829 um, without 0.3808, 0.3823,
    0.3827, 0.3827; with twice the bound 0.3810, 0.3824, 0.3828, 0.3829, and the gear at 20 deg C does not start.
    """
    y, wet, driving = V(0.0), S[P, at.k] > 0.0, driving_x(S, at)
    x = within(limited(*along_x(S, at)), -driving, driving) / G[0, DX]
    if at.ny > 0:
        driving = driving_y(S, at)
        y = within(limited(*along_y(S, at)), -driving, driving) / G[0, DY]
    return ti.select(wet, x, V(0.0)), ti.select(wet, y, V(0.0))


@ti.func
def driving_x(S: ti.template(), at: ti.template()):
    """Difference of P that drives the mean flux to both neighbours, with the viscosity of the node."""
    here = node(S, at.k, 0, 0, -1)
    behind, ahead = flux_x(S, at.k - ti.min(at.i, 1)), flux_x(S, at.k - ti.max(at.i - at.nx + 1, 0))
    return 0.5 * (behind + ahead) / mobility(here)


@ti.func
def driving_y(S: ti.template(), at: ti.template()):
    """Driving difference along y."""
    n2 = at.nx + 1
    here = node(S, at.k, n2, 0, -1)
    return 0.5 * (flux(node(S, at.k, n2, -1, -1), here) + flux(here, node(S, at.k, n2, 1, -1))) / mobility(here)


@ti.func
def limited(a, b):
    """Central difference from two one-sided ones, at most twice the smaller, 0 for different signs (van Leer 1977).

    His harmonic mean would be wrong by a quarter beside every plane of symmetry.
    """
    size = ti.min(2.0 * ti.min(ti.abs(a), ti.abs(b)), 0.5 * ti.abs(a + b))
    return ti.select(a * b > 0.0, ti.select(a > 0.0, size, -size), V(0.0))
