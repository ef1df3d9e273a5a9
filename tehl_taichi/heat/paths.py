"""Where the oil of a film came from: values one and two steps ago at the departure points of its nodes."""

import taichi as ti

from tehl_taichi.engine.lanes import Table, V, W, cells, tile, tiles
from tehl_taichi.heat.film import Coefficients
from tehl_taichi.heat.slots import KINDS, MS, MSN, MSNN, PN, PNN, PS, TN, TNN, TS, VY, T, U, slots_around
from tehl_taichi.heat.step import BACK, BACK_2, FAR, INV_X, INV_Y, NEAR
from tehl_taichi.pressure.fields import P


@ti.func
def cubic(f):
    """Lagrange weights of the nodes -1, 0, 1, 2 at f."""
    return (-f * (f - 1.0) * (f - 2.0) / 6.0, (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0, -(f + 1.0) * f * (f - 2.0) / 2.0,
            (f + 1.0) * f * (f - 1.0) / 6.0)


@ti.func
def within(value, a, b):
    return ti.min(ti.max(value, ti.min(a, b)), ti.max(a, b))


@ti.func
def along_x(Z: ti.template(), first, nx, warm, press, at, inflow):
    """Slots `warm` and `press` of a block at x = at (in cells): cubic, within the two nearest values; from the left comes oil
    of temperature `inflow` and pressure 0. Rows that come from one cell, as nearly all neighbours do, are taken together."""
    i0 = int(ti.floor(at[0]))
    together = 1
    for u in ti.static(range(1, W)):
        if int(ti.floor(at[u])) != i0:
            together = 0
    T0, p0 = V(0.0), V(0.0)
    if together == 1:
        T0, p0 = from_cell(Z, first, nx, warm, press, i0, at - i0, inflow)
    else:
        for u in ti.static(range(W)):
            i = int(ti.floor(at[u]))
            T, p = from_cell(Z, first, nx, warm, press, i, at - i, inflow)
            T0[u], p0[u] = T[u], p[u]
    return T0, p0


@ti.func
def from_cell(Z: ti.template(), first, nx, warm, press, i0, f, inflow):
    """The same for all rows from the cell behind column i0, at the fractions f of it."""
    T4, p4 = [V(inflow) for _ in range(4)], [V(0.0) for _ in range(4)]
    for t in ti.static(range(4)):
        if i0 - 1 + t >= 0:
            q = first + ti.min(i0 - 1 + t, nx)
            T4[t], p4[t] = Z[q, warm], Z[q, press]
    w = cubic(f)
    T, p = V(0.0), V(0.0)
    for t in ti.static(range(4)):
        T += w[t] * T4[t]
        p += w[t] * p4[t]
    return within(T, T4[1], T4[2]), within(p, p4[1], p4[2])


@ti.func
def along_y(Z: ti.template(), q, slot, n2, s, ny, moved):
    """Change of a slot by flow along y, moved = v dt/dy: quadratic, within the two nearest values."""
    here = Z[q, slot]
    lower, upper = slots_around(Z, q, slot, n2, s, ny)
    value = here + 0.5 * moved * (lower - upper + moved * (upper - 2.0 * here + lower))
    return within(value, here, ti.select(moved > 0.0, lower, upper)) - here


@ti.func
def origin(Z: ti.template(), q, s, i, nx, ny, nz, n, warm, press, step: ti.template(), back_by, inflow):
    """Two slots (temperature, pressure) at the place where the oil of node n was step[0, back_by] seconds ago."""
    n2, back = nx + 1, step[0, back_by]
    at = i - Z[q, U * nz + n] * (back * step[0, INV_X])
    T0, p0 = along_x(Z, s * n2, nx, warm, press, at, inflow)
    if ny > 0:
        moved = ti.min(ti.max(Z[q, VY * nz + n] * (back * step[0, INV_Y]), -1.0), 1.0)
        # between the two columns next to the first row's origin: taken at i, the step would be of first order in x y
        i0 = ti.min(ti.max(int(ti.floor(at[0])), 0), nx - 1)
        f, q0 = ti.min(ti.max(at - i0, -1.0), 2.0), s * n2 + i0
        T0 += (1.0 - f) * along_y(Z, q0, warm, n2, s, ny, moved) + f * along_y(Z, q0 + 1, warm, n2, s, ny, moved)
        p0 += (1.0 - f) * along_y(Z, q0, press, n2, s, ny, moved) + f * along_y(Z, q0 + 1, press, n2, s, ny, moved)
    return T0, p0


@ti.kernel
def departures(S: ti.template(), Z: ti.template(), G: Table, nz: ti.i32, p_H: ti.f64, inflow: ti.f64, step: Coefficients):
    """Temperature and pressure where the oil of each node was one and two steps ago (BDF2 along its path): cubic along x,
    quadratic along y.

    inflow: temperature of what comes in from the left.
    """
    nx, ny, off = cells(G, 0)
    base = KINDS * nz
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        near, far = step[0, NEAR], step[0, FAR]
        for i in range(first, last):
            q = s * (nx + 1) + i
            for n in range(nz):
                warm, press = origin(Z, q, s, i, nx, ny, nz, n, TN * nz + n, base + PN, step, BACK, inflow)
                if far != 0.0:
                    warm_2, press_2 = origin(Z, q, s, i, nx, ny, nz, n, TNN * nz + n, base + PNN, step, BACK_2, inflow)
                    warm, press = near * warm + far * warm_2, near * press + far * press_2
                Z[q, TS * nz + n] = warm
                Z[q, PS * nz + n] = S[P, off + q] * p_H - press


@ti.kernel
def accept(S: ti.template(), Z: ti.template(), G: Table, nz: ti.i32, p_H: ti.f64):
    """The present state becomes that of the last step."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        for q in range(s * (nx + 1) + first, s * (nx + 1) + last):
            for n in range(nz):
                Z[q, TNN * nz + n], Z[q, TN * nz + n] = Z[q, TN * nz + n], Z[q, T * nz + n]
                Z[q, MSNN * nz + n], Z[q, MSN * nz + n] = Z[q, MSN * nz + n], Z[q, MS * nz + n]
            Z[q, KINDS * nz + PNN], Z[q, KINDS * nz + PN] = Z[q, KINDS * nz + PN], S[P, off + q] * p_H
