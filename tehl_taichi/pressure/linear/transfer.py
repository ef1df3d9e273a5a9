"""Grid transfers between each level and the next coarser one (every second node), block by block."""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import L, Table, V, W, cells
from tehl_taichi.pressure.fields import COR, DRY, JN, KIND, LINES, RES, TOUCH, H, P
from tehl_taichi.pressure.linear.line_solver import DRY_KIND, LOCAL, is_kind

HALF_W = W // 2
Rows = ti.types.ndarray(dtype=ti.i32, ndim=1)  # of the table S


@ti.func
def every_second(S: ti.template(), row, k, n2):
    """Lanes of a coarse block: rows 2 j of the two fine blocks at columns k and k + n2."""
    a, b, out = S[row, k], S[row, k + n2], V(0.0)
    for u in ti.static(range(W)):
        if ti.static(2 * u < W):
            out[u] = a[2 * u]
        else:
            out[u] = b[2 * u - W]
    return out


@ti.func
def inject_block(S: ti.template(), J: ti.template(), G: ti.template(), l, t, rows: ti.template()):
    """Copy the fields `rows` of block t of level l + 1 from the coinciding nodes of level l; set KIND."""
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    first, fine = coff + t * (mx + 1), off + 2 * t * (nx + 1)
    for n in range(rows.shape[0]):
        row = rows[n]
        for I in range(mx + 1):
            S[row, first + I] = every_second(S, row, fine + 2 * I, nx + 1)
    for c in range(first, first + mx + 1):
        for u in ti.static(range(W)):
            if t * W + u >= int(G[l + 1, JN]):
                S[DRY, c][u] = 1.0
                S[TOUCH, c][u] = 0.0
                if t * W + u > my:
                    S[P, c][u] = 0.0
                    S[H, c][u] = 1.0
        J[KIND, c] = ti.select(S[DRY, c] > 0.0, L(J, DRY_KIND), L(J, LOCAL))


@ti.kernel
def inject(S: ti.template(), J: ti.template(), G: Table, levels: ti.i32, shared: ti.i32, rows: Rows, alone: ti.template()):
    """Copy the fields `rows` (state, sets, laws) of every coarser level from the coinciding nodes of the finest level.

    Ghosts stay dry. KIND is set to dry or local, for levels without lines. shared: number of blocks of the first coarser level,
    which are copied in parallel.
    """
    ti.loop_config(block_dim=1, serialize=alone)
    for t in range(shared):
        inject_block(S, J, G, 0, t, rows)
    ti.loop_config(serialize=True)
    for _ in range(1):
        for l in range(1, levels - 1):
            for t in range(cells(G, l + 1)[1] // W + 1):
                inject_block(S, J, G, l, t, rows)


@ti.func
def wet(J: ti.template(), k):
    """RES of column k, 0 at dry nodes."""
    return ti.select(is_kind(J, k, DRY_KIND), L(J, 0.0), J[RES, k])


@ti.func
def weighted_x(J: ti.template(), k):
    """RES of wet nodes, weighted 1/4, 1/2, 1/4 along x around column k."""
    return L(J, 0.5) * wet(J, k) + L(J, 0.25) * (wet(J, k - 1) + wet(J, k + 1))


@ti.func
def transfer_weights(J: ti.template(), G: ti.template(), l, t):
    """Weights along y of the fine rows 2 j - 1, 2 j, 2 j + 1 for the coarse rows of block t; mirrored at the borders."""
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
def restrict_column(J: ti.template(), c, k, n2, t, lower, centre, upper):
    """Set RES of column c of coarse block t from the fine columns around k; lower, centre, upper: weights of its rows."""
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
def restrict_block(J: ti.template(), G: ti.template(), l, t):
    """Set RES of block t of level l + 1 from level l."""
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    n2 = nx + 1
    lower, centre, upper = transfer_weights(J, G, l, t)
    for I in range(mx + 1):
        restrict_column(J, coff + t * (mx + 1) + I, off + 2 * t * n2 + 2 * I, n2, t, lower, centre, upper)


@ti.func
def doubled(J: ti.template(), c, m2, upper_half):
    """Correction at the fine rows j of a block from column c of the coarse block: mean of rows j // 2 and (j + 1) // 2."""
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
    """Add `change` to COR of column k, 0 at dry nodes; own: whether COR has a value on this level."""
    before = ti.select(own, J[COR, k], L(J, 0.0))
    J[COR, k] = before + ti.select(is_kind(J, k, DRY_KIND), L(J, 0.0), change)


@ti.func
def prolong_block(J: ti.template(), G: ti.template(), l, s, damping):
    """Add COR of level l + 1, times `damping`, to block s of level l."""
    nx, ny, off = cells(G, l)
    mx, my, coff = cells(G, l + 1)
    first, c, half = off + s * (nx + 1), coff + s // 2 * (mx + 1), s % 2
    own, share = G[l, LINES] > 0.0, ti.cast(damping, J.dtype)
    left = doubled(J, c, mx + 1, half)
    for I in range(mx):
        right = doubled(J, c + I + 1, mx + 1, half)
        k = first + 2 * I
        add_where_wet(J, k, own, share * left)
        add_where_wet(J, k + 1, own, share * (L(J, 0.5) * (left + right)))
        left = right
