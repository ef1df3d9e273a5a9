"""Grid transfers between each level and the next coarser one (every second node), all levels in one launch.

The transfers to and from the finest level run in parallel; the others are too small for that and run in one thread.
"""

import taichi as ti

from tehl_taichi.engine.lanes import Blocks, L, LinearFlat, Table, V, W, cells, lanes_in, lanes_out
from tehl_taichi.pressure.fields import COR, DRY, JN, KIND, LINES, RES, SCALE, TOUCH, H, P
from tehl_taichi.pressure.lines import DRY_KIND, LOCAL, collect_block, is_kind

HALF_W = W // 2


@ti.func
def every_second(S: ti.template(), row, k, n2):
    """Lanes of a coarse block: the rows 2 j of the fine blocks at columns k and k + n2."""
    a, b, out = S[row, k], S[row, k + n2], V(0.0)
    for u in ti.static(range(W)):
        if ti.static(2 * u < W):
            out[u] = a[2 * u]
        else:
            out[u] = b[2 * u - W]
    return out


@ti.kernel
def inject(S: ti.template(), J: ti.template(), G: Table, levels: ti.i32, rows: ti.template()):
    """The fields `rows` (state, sets, laws) of every coarser level from the coinciding nodes of the finest; ghosts stay dry.
    KIND: what is dry, for levels that corrections only pass through."""
    ti.loop_config(serialize=True)
    for _ in range(1):
        for l in range(levels - 1):
            nx, ny, off = cells(G, l)
            mx, my, coff = cells(G, l + 1)
            for t in range(my // W + 1):
                for I in range(mx + 1):
                    c, k = coff + t * (mx + 1) + I, off + 2 * t * (nx + 1) + 2 * I
                    for row in ti.static(rows):
                        S[row, c] = every_second(S, row, k, nx + 1)
                    for u in ti.static(range(W)):
                        if t * W + u >= int(G[l + 1, JN]):
                            S[DRY, c][u] = 1.0
                            S[TOUCH, c][u] = 0.0
                            if t * W + u > my:
                                S[P, c][u] = 0.0
                                S[H, c][u] = 1.0
                    J[KIND, c] = ti.select(S[DRY, c] > 0.0, L(J, DRY_KIND), L(J, LOCAL))


@ti.func
def wet(J: ti.template(), k):
    return ti.select(is_kind(J, k, DRY_KIND), L(J, 0.0), J[RES, k])


@ti.func
def weighted_x(J: ti.template(), k):
    return L(J, 0.5) * wet(J, k) + L(J, 0.25) * (wet(J, k - 1) + wet(J, k + 1))


@ti.func
def transfer_weights(J: ti.template(), G: ti.template(), l, t):
    """y weights of the fine rows 2 j - 1, 2 j, 2 j + 1 for the coarse rows of block t; mirrored at the borders."""
    my = cells(G, l + 1)[1]
    lower, centre, upper = L(J, 0.25), L(J, 0.5), L(J, 0.25)
    for u in ti.static(range(W)):
        j = t * W + u
        if j == 0:
            lower[u], upper[u] = 0.0, 0.5
        elif j == my and int(G[l + 1, JN]) == my + 1:
            lower[u], upper[u] = 0.5, 0.0
        if my == 0:
            lower[u], centre[u], upper[u] = 0.0, 1.0, 0.0
    return lower, centre, upper


@ti.func
def restrict_block(J: ti.template(), G: ti.template(), l, t):
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    n2 = nx + 1
    lower, centre, upper = transfer_weights(J, G, l, t)
    for I in range(mx + 1):
        c, k = coff + t * (mx + 1) + I, off + 2 * t * n2 + 2 * I
        a, b, before = weighted_x(J, k), weighted_x(J, k + n2), ti.cast(0.0, J.dtype)
        if t > 0:
            before = weighted_x(J, k - n2)[W - 1]
        out = L(J, 0.0)
        for u in ti.static(range(W)):
            if ti.static(2 * u < W):
                down = before
                if ti.static(u > 0):
                    down = a[2 * u - 1]
                out[u] = lower[u] * down + centre[u] * a[2 * u] + upper[u] * a[2 * u + 1]
            else:
                down = a[W - 1]
                if ti.static(2 * u > W):
                    down = b[2 * u - W - 1]
                out[u] = lower[u] * down + centre[u] * b[2 * u - W] + upper[u] * b[2 * u - W + 1]
        J[RES, c] = ti.select(is_kind(J, c, DRY_KIND), L(J, 0.0), out + out)


@ti.func
def copy_out(J: ti.template(), G: ti.template(), l, row: ti.template(), values: ti.template()):
    nx, ny, off = cells(G, l)
    for q in range((ny // W + 1) * (nx + 1)):
        lanes_out(values, q, J[row, off + q])


@ti.kernel
def descend(J: ti.template(), G: Table, levels: ti.i32, r: LinearFlat, coarse: LinearFlat, alone: ti.template()):
    """RES of the finest level = r times the row scale, and of the coarser ones: twice the full weighting (rows carry
    dx), 0 at dry nodes of either level; `coarse` gets that of the coarsest."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        for q in range(s * (nx + 1), (s + 1) * (nx + 1)):
            J[RES, off + q] = lanes_in(r, q) * J[SCALE, off + q]
    ti.loop_config(block_dim=1, serialize=alone)
    for t in range(cells(G, ti.min(1, levels - 1))[1] // W + 1):
        if levels > 1:
            restrict_block(J, G, 0, t)
    ti.loop_config(serialize=True)
    for _ in range(1):
        for l in range(1, levels - 1):
            for t in range(cells(G, l + 1)[1] // W + 1):
                restrict_block(J, G, l, t)
        copy_out(J, G, levels - 1, RES, coarse)


@ti.func
def doubled(J: ti.template(), c, m2, upper_half):
    """Correction at the fine rows of a block from the coarse block at c: mean of rows j // 2 and (j + 1) // 2."""
    v, rim = J[COR, c], J[COR, c + m2][0]
    out = L(J, 0.0)
    for u in ti.static(range(W)):
        a, b = v[u // 2], v[(u + 1) // 2]
        if upper_half:
            a = v[HALF_W + u // 2]
            if ti.static(HALF_W + (u + 1) // 2 < W):
                b = v[HALF_W + (u + 1) // 2]
            else:
                b = rim
        out[u] = a + b
    return L(J, 0.5) * out


@ti.func
def add_where_wet(J: ti.template(), k, own, change):
    J[COR, k] = own * J[COR, k] + ti.select(is_kind(J, k, DRY_KIND), L(J, 0.0), change)


@ti.func
def prolong_block(J: ti.template(), G: ti.template(), l, s, damping):
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    first, c, half = off + s * (nx + 1), coff + s // 2 * (mx + 1), s % 2
    own, share = ti.cast(G[l, LINES], J.dtype), ti.cast(damping, J.dtype)
    left = doubled(J, c, mx + 1, half)
    for I in range(mx):
        right = doubled(J, c + I + 1, mx + 1, half)
        k = first + 2 * I
        add_where_wet(J, k, own, share * left)
        add_where_wet(J, k + 1, own, share * (L(J, 0.5) * (left + right)))
        left = right


@ti.kernel
def ascend(J: ti.template(), G: Table, blocks: Blocks, solved: ti.i32, levels: ti.i32, spread: LinearFlat,
           coarse: LinearFlat, damping: ti.f64, z: LinearFlat, alone: ti.template()):
    """COR of each level from its line solution (the first `solved` blocks) or from `coarse`, or nothing, plus damping times
    the bilinear interpolation of the next coarser one, from coarse to fine, where wet; z gets that of the finest."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for b in range(solved):
        collect_block(J, G, blocks[b, 0], blocks[b, 1], spread)
    ti.loop_config(serialize=True)
    for _ in range(1):
        mx, my, last = cells(G, levels - 1)
        if blocks[solved - 1, 0] < levels - 1:
            for q in range((my // W + 1) * (mx + 1)):
                J[COR, last + q] = lanes_in(coarse, q)
        for step in range(levels - 2):
            l = levels - 2 - step
            for s in range(cells(G, l)[1] // W + 1):
                prolong_block(J, G, l, s, damping)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        if levels > 1:
            prolong_block(J, G, 0, s, damping)
        for q in range(s * (nx + 1), (s + 1) * (nx + 1)):
            lanes_out(z, q, J[COR, off + q])
