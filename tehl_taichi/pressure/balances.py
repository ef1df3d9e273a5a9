"""Complementarity, active sets and balances of the present state: partial sums per block, added in a fixed order."""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import Flat, LinearFlat, Table, V, W, cells, lanes_in, lanes_out, row_shares
from tehl_taichi.pressure.fields import DRY, FLOOR, K0, MASK, RHO, SCALE, TOUCH, WEIGHT, D, H, P, R

PHI2, LOAD, OUTFLOW, COUETTE = range(4)  # columns of the sums of each block
SUMS = 4


@ti.func
def parts(S: ti.template(), k, floor, inv):
    """Three sides of the complementarity: P, R/D, (H - H_floor)/K_00; inv = 1/K_00."""
    return S[P, k], S[R, k] / S[D, k], (S[H, k] - floor) * inv


@ti.func
def sets(p, r, gap, inside):
    """(touch, dry) of a node, 1 or 0: the smallest side of the complementarity; other nodes have a full film."""
    touch = ti.select(gap < ti.min(p, r), inside, V(0.0))
    return touch, ti.max(ti.select(p - r <= 0.0, 1.0 - touch, V(0.0)), 1.0 - inside)


@ti.kernel
def sums(S: ti.template(), G: Table, middle: ti.i32, out: Table, alone: ti.template()):
    """Partial sums out[block, ...]: PHI2 of the complementarity, LOAD, OUTFLOW (net, of the full-film region), COUETTE (flux
    through the column `middle`).
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        floor, inv = G[0, FLOOR], 1 / G[0, K0]
        share = row_shares(s, ny)
        phi2, load_sum, mass = V(0.0), V(0.0), V(0.0)
        for i in range(nx + 1):
            k = off + s * (nx + 1) + i
            a, b, c = parts(S, k, floor, inv)
            phi = ti.select(S[MASK, k] > 0.0, ti.min(ti.min(a, b), c), V(0.0))
            phi2 += phi * phi
            load_sum += S[WEIGHT, k] * S[P, k]
            # not P > 0: a pressure of 1e-12 left on a ruptured node would count its whole residual
            touch, dry = sets(a, b, c, S[MASK, k])
            mass += share * S[R, k] * (1.0 - touch) * (1.0 - dry)
        m = off + s * (nx + 1) + middle
        couette = ti.select(S[MASK, m] > 0.0, share, V(1.0)) * S[RHO, m] * S[H, m]  # given rows lie on no mirror
        for u in ti.static(range(W)):
            if s * W + u > ny:
                couette[u] = 0.0
        out[s, PHI2], out[s, LOAD], out[s, OUTFLOW], out[s, COUETTE] = phi2.sum(), load_sum.sum(), mass.sum(), couette.sum()


@ti.kernel
def choose_sets(S: ti.template(), J: ti.template(), G: Table, cap: ti.f64, b: LinearFlat, mass_row: LinearFlat,
                touching: Table, alone: ti.template()):
    """Set DRY, TOUCH and the row scale.

    b: right-hand side of the scaled Newton equations (the caller sets touching rows); mass_row: weight of each scaled row in
    the net outflow; touching[block, 0]: number of touching nodes.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        floor, inv = G[0, FLOOR], 1 / G[0, K0]
        share = row_shares(s, ny)
        count = V(0.0)
        for i in range(nx + 1):
            k = off + s * (nx + 1) + i
            p, r, gap = parts(S, k, floor, inv)
            inside = S[MASK, k]
            touch, dry = sets(p, r, gap, inside)
            scale = ti.select(dry > 0.0, V(1.0), ti.min(S[D, k], cap))
            S[TOUCH, k], S[DRY, k], J[SCALE, k] = touch, dry, ti.cast(scale, J.dtype)
            lanes_out(b, k - off, ti.select(dry > 0.0, -p * inside, -S[R, k] / scale * inside))
            lanes_out(mass_row, k - off, share * scale * (1.0 - dry) * (1.0 - touch))
            count += touch
        touching[s, 0] = count.sum()


@ti.kernel
def advance(S: ti.template(), G: Table, old: Flat, step: LinearFlat, t: Flat, alone: ti.template()):
    """Set P = max(old + t[0] step, 0) on the unknowns."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        for q in range(s * (nx + 1), (s + 1) * (nx + 1)):
            p = lanes_in(old, q)
            S[P, off + q] = ti.select(S[MASK, off + q] > 0.0, ti.max(p + t[0] * lanes_in(step, q), 0.0), p)


@ti.kernel
def save(S: ti.template(), G: Table, row: ti.i32, out: Flat, alone: ti.template()):
    """Copy S[row] of the finest level to `out`, in block order."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        for q in range(s * (nx + 1), (s + 1) * (nx + 1)):
            lanes_out(out, q, S[row, off + q])
