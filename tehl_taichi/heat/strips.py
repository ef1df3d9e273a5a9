"""Material strips of both bodies: heat of earlier steps, stored in the bodies' own frames.

F[column, slot]: the modes of body a and of body b (`count` each), the flux of the last step into both, one scratch slot. A
column belongs to a material strip; strips move over the grid by whole cells and a fraction (Drift), and enter cold from the
left.
"""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import read
from tehl_taichi.engine.simd import Flat, Table, V, W, cells
from tehl_taichi.heat.departure_points import cubic
from tehl_taichi.heat.heat_step import Drift

# rows: weight, decay over the step, gain of the new flux and of the last one (linear in between)
Modes = ti.types.ndarray(dtype=ti.f64, ndim=2)
WEIGHT, DECAY, GAIN, GAIN_LAST = range(4)


@ti.pyfunc
def kept(count):
    """Number of slots kept for the next step."""
    return 2 * count + 2


@ti.pyfunc
def memory(count, body):
    """(slot of the first mode of a body, slot of the last flux into it)."""
    return body * count, 2 * count + body


def width(count):
    """Total number of slots."""
    return kept(count) + 1


@ti.func
def interpolate(F: ti.template(), first, i, nx, slot, rest):
    """Value at i + rest by cubic interpolation, constant beyond the ends."""
    w, out = cubic(rest), V(0.0)
    for t in ti.static(range(4)):
        out += w[t] * F[first + ti.min(ti.max(i + t - 1, 0), nx), slot]
    return out


@ti.kernel
def surface(F: ti.template(), C: ti.template(), G: Table, modes: Modes, drift: Flat, count: ti.i32, body: ti.i32,
            ambient: ti.f64, slot: ti.i32):
    """Set C[slot] = A of T_s = A + B q at the nodes of the contact; material strip i is at x_i + rest dx."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        first, scratch = s * (nx + 1), kept(count)
        lies = read(Drift, drift)
        shift = int(lies.shift)
        modes_at, flux_at = memory(count, body)
        for i in range(nx + 1):
            total = V(ambient)
            if i - shift >= 0:
                strip = first + ti.min(i - shift, nx)
                total += lies.B_last * F[strip, flux_at]
                for m in range(count):
                    total += modes[WEIGHT, m] * modes[DECAY, m] * F[strip, modes_at + m]
            F[first + i, scratch] = total
        for i in range(nx + 1):
            C[first + i, slot] = interpolate(F, first, i - 1, nx, scratch, 1.0 - lies.rest)


@ti.kernel
def remember(F: ti.template(), C: ti.template(), G: Table, modes: Modes, drift: Flat, count: ti.i32, body: ti.i32,
             slot: ti.i32):
    """Update the memory of a body from the flux C[slot] of this step and that of the last one; starts at the side where strips
    leave, so that each is read before it is overwritten.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        first, lies = s * (nx + 1), read(Drift, drift)
        shift = int(lies.shift)
        modes_at, flux_at = memory(count, body)
        for n in range(nx + 1):
            i = nx - n if shift >= 0 else n
            strip = first + ti.min(i - shift, nx)
            q, last = interpolate(C, first, i, nx, slot, lies.rest), V(0.0)
            if i - shift >= 0:
                last = F[strip, flux_at]
            for m in range(count):
                old = V(0.0)
                if i - shift >= 0:
                    old = F[strip, modes_at + m]
                F[first + i, modes_at + m] = modes[DECAY, m] * old + modes[GAIN, m] * q + modes[GAIN_LAST, m] * last
            F[first + i, flux_at] = q
