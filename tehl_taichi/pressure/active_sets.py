"""Rows of the Jacobian for dry nodes (P = 0) and nodes in solid contact (film at its floor)."""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import Blocks, L, Table, cells
from tehl_taichi.pressure.fields import AD, AU, BD, BU, CT, DRY, FRAME, RHO, STENCIL, TOUCH, A, B
from tehl_taichi.pressure.upwind import couette_weights


@ti.func
def contact_rows(S: ti.template(), J: ti.template(), G: ti.template(), l, k, i):
    """Rows of touching nodes: the transport operator on rho W of the touching nodes (equivalent to W = 0 there)."""
    w, touch = couette_weights(i), S[TOUCH, k] > 0.0
    for t in ti.static(range(4)):
        c = (1.0 - G[l, FRAME]) * w[t]
        if ti.static(t == 2):
            c += G[l, CT]
        mass = ti.cast(c * S[RHO, k + t - 2] * S[TOUCH, k + t - 2], J.dtype)
        J[A[t], k] = ti.select(touch, L(J, 0.0), J[A[t], k])
        J[B[t], k] = ti.select(touch, mass, J[B[t], k])
    for row in ti.static((AU, AD, BU, BD)):
        J[row, k] = ti.select(touch, L(J, 0.0), J[row, k])


@ti.func
def dry_rows(S: ti.template(), J: ti.template(), k):
    """Rows of dry nodes: the identity."""
    dry = S[DRY, k] > 0.0
    for row in ti.static(STENCIL):
        J[row, k] = ti.select(dry, L(J, 0.0), J[row, k])
    J[A[2], k] = ti.select(dry, L(J, 1.0), J[A[2], k])


@ti.kernel
def replace_rows(S: ti.template(), J: ti.template(), G: Table, blocks: Blocks, touching: ti.i32, alone: ti.template()):
    """Replace the rows of dry and touching nodes on every level that is solved."""
    ti.loop_config(block_dim=1, serialize=alone)
    for b in range(blocks.shape[0]):
        l, s = blocks[b, 0], blocks[b, 1]
        nx, _, off = cells(G, l)
        for i in range(nx + 1):
            k = off + s * (nx + 1) + i
            if touching == 1:
                contact_rows(S, J, G, l, k, i)
            dry_rows(S, J, k)
