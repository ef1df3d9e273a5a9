"""Surface temperatures of the bodies: heat that went in earlier, remembered in the bodies' own frames.

F[column, slot]: the memory modes of body a, those of body b, then both again for the new step, then one scratch slot; a
column belongs to a material strip, which the grid of the contact overtakes by whole cells (`shift`) and a rest (`rest`).
"""

import taichi as ti

from tehl_taichi.kernels.film import cubic
from tehl_taichi.kernels.lanes import Table, V, W, cells

Modes = ti.types.ndarray(dtype=ti.f64, ndim=2)  # rows: weight, decay over the step, gain of the step; then shift, rest


@ti.func
def interpolate(F: ti.template(), first, i, nx, slot, rest):
    """Value at i + rest, cubic, the ends continued."""
    w, out = cubic(rest), V(0.0)
    for t in ti.static(range(4)):
        out += w[t] * F[first + ti.min(ti.max(i + t - 1, 0), nx), slot]
    return out


@ti.kernel
def surface(F: ti.template(), Z: ti.template(), G: Table, modes: Modes, count: ti.i32, body: ti.i32, ambient: ti.f64,
            slot: ti.i32):
    """Z[slot] = A of T_s = A + B q at the nodes of the contact; material strip i lies at x_i + rest dx."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        first, scratch = s * (nx + 1), 4 * count
        shift, rest = int(modes[3, 0]), modes[3, 1]
        for i in range(nx + 1):
            total = V(ambient)
            if i - shift >= 0:
                for m in range(count):
                    total += modes[0, m] * modes[1, m] * F[first + i - shift, body * count + m]
            F[first + i, scratch] = total
        for i in range(nx + 1):
            Z[first + i, slot] = interpolate(F, first, i - 1, nx, scratch, 1.0 - rest)


@ti.kernel
def remember(F: ti.template(), Z: ti.template(), G: Table, modes: Modes, count: ti.i32, body: ti.i32, slot: ti.i32):
    """The new memory of a body from the flux Z[slot] of this step."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        first, shift, rest = s * (nx + 1), int(modes[3, 0]), modes[3, 1]
        for i in range(nx + 1):
            q = interpolate(Z, first, i, nx, slot, rest)
            for m in range(count):
                old = V(0.0)
                if i - shift >= 0:
                    old = F[first + i - shift, body * count + m]
                F[first + i, (2 + body) * count + m] = modes[1, m] * old + modes[2, m] * q


@ti.kernel
def adopt(F: ti.template(), G: Table, count: ti.i32):
    """The new memory of both bodies becomes the present one."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        for q in range(s * (nx + 1), (s + 1) * (nx + 1)):
            for m in range(2 * count):
                F[q, m] = F[q, 2 * count + m]
