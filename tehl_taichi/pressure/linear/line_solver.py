"""Line solver along x: one small banded system (7 diagonals) per row, W rows per lane vector, all blocks at once.

Columns are of two kinds. A local column ("Gauss-Seidel") changes the pressure of one node: where the Poiseuille flow is strong,
with the local part of the deflection kernel in the matrix. A distributed column changes the film of one node: in the
high-pressure zone eps is about 1e-10 and the equation is pure transport of rho H. There the change of pressure is K^-1 (symbol
|k|, one unpadded FFT) of a unit change of the film, so the rows are banded transport.
"""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import Blocks, L, LinearTable, Table, V, W, above, below, cells, neighbour_masks
from tehl_taichi.pressure.fields import AD, AU, BAND, CT, DRY, DX, EPS, FRAME, JN, K0, KIND, RES, SOL, STENCIL, TOUCH, A, B

HALF = 3  # half bandwidth; 2 converges more slowly, 1 diverges, 4 to 6 gain nothing
TINY_PIVOT = 1e-14
REACH = HALF + 3  # number of distances between a column of the band and the nodes of the stencil
NEAR = 8  # distances in the tables of the kernels
DRY_KIND, LOCAL, DISTRIBUTED = 0.0, 1.0, 2.0  # values of KIND


@ti.func
def is_kind(J: ti.template(), k, kind: ti.template()):
    """Whether nodes of column k have this kind, lane by lane."""
    return J[KIND, k] == L(J, kind)


@ti.func
def kind_of(S: ti.template(), J: ti.template(), G: ti.template(), l, k, n2, i, up, down, rest, narrow, wide):
    """Kinds of the nodes of column k (i: its number along x).

    Local are nodes with strong Poiseuille flow, with a dry neighbour, or beside an end of the grid; touching nodes are
    distributed.
    """
    dry = S[DRY, k - 1] + S[DRY, k + 1] + up * above(S, DRY, k, n2) + down * below(S, DRY, k, n2)
    bound = G[l, K0] * (rest * (1.0 - G[l, FRAME]) + (narrow + wide / G[l, DX]) * G[l, CT])
    if i == 1 or i == n2 - 2:
        bound = -1.0
    strong = ti.select(J[EPS, k] > bound, V(1.0), V(0.0)) + dry
    kind = ti.select(strong > 0.0, L(J, LOCAL), L(J, DISTRIBUTED))
    kind = ti.select(S[TOUCH, k] > 0.0, L(J, DISTRIBUTED), kind)
    return ti.select(S[DRY, k] > 0.0, L(J, DRY_KIND), kind)


@ti.kernel
def classify(S: ti.template(), J: ti.template(), G: Table, blocks: Blocks, rest: ti.f64, narrow: ti.f64, wide: ti.f64,
             alone: ti.template()):
    """Set KIND of every node in the blocks.

    A node is local if its Poiseuille coefficient EPS exceeds a bound with two parts: `rest` times the transport through the
    grid, and the storage in time over `narrow` cells and `wide` half-widths.
    """
    ti.loop_config(block_dim=1, serialize=alone)
    for b in range(blocks.shape[0]):
        l, s = blocks[b, 0], blocks[b, 1]
        nx, ny, off = cells(G, l)
        n2 = nx + 1
        up, down = neighbour_masks(G, l, s)
        for i in range(n2):
            k = off + s * n2 + i
            J[KIND, k] = kind_of(S, J, G, l, k, n2, i, up, down, rest, narrow, wide)


@ti.func
def gauss_seidel_entry(J: ti.template(), k, dk: ti.template(), near: ti.template(), rim: ti.template(), outer):
    """Matrix entry of row k and local column k + dk: a unit pressure there, and the film change that it causes nearby."""
    v = L(J, 0.0)
    for t in ti.static(range(-2, 2)):
        v += J[B[t + 2], k] * (near[abs(t - dk)] + outer * rim[abs(t - dk)])
    if ti.static(-2 <= dk <= 1):
        v += J[A[dk + 2], k]
    return v


@ti.func
def distributed_entry(J: ti.template(), k, dk: ti.template(), inverse: ti.template(), beside: ti.template()):
    """Matrix entry of row k and distributed column k + dk: a unit film change there, and the pressure that causes it."""
    v = (J[AU, k] + J[AD, k]) * beside[abs(dk)]
    for t in ti.static(range(-2, 2)):
        v += J[A[t + 2], k] * inverse[abs(t - dk)]
    if ti.static(-2 <= dk <= 1):
        v += J[B[dk + 2], k]
    return v


@ti.func
def fill_row(J: ti.template(), k, i, nx, near: ti.template(), rim: ti.template(), inverse: ti.template(),
             beside: ti.template(), outer):
    """Write the seven entries of a node's row; columns without an unknown are 0, rows of dry nodes are the identity."""
    dry = is_kind(J, k, DRY_KIND)
    for b in ti.static(range(2 * HALF + 1)):
        v = ti.select(is_kind(J, k + b - HALF, LOCAL), gauss_seidel_entry(J, k, b - HALF, near, rim, outer),
                      distributed_entry(J, k, b - HALF, inverse, beside))
        v = ti.select(is_kind(J, k + b - HALF, DRY_KIND), L(J, 0.0), v)
        if i + b - HALF <= 0 or i + b - HALF >= nx:
            v = L(J, 0.0)
        if ti.static(b == HALF):
            J[BAND[b], k] = ti.select(dry, L(J, 1.0), v)
        else:
            J[BAND[b], k] = ti.select(dry, L(J, 0.0), v)


@ti.func
def row_of(table: ti.template(), n):
    """The first REACH entries of a row of a table, as constants of a loop."""
    return ti.Vector([table[n, m] for m in ti.static(range(REACH))])


@ti.func
def reciprocal(J: ti.template(), pivot):
    """1/pivot, with the pivot at least TINY_PIVOT."""
    return L(J, 1.0) / ti.select(ti.abs(pivot) < L(J, TINY_PIVOT), L(J, TINY_PIVOT), pivot)


@ti.func
def factorise(J: ti.template(), first, n2):
    """LU factors by rows without pivoting, in place; the diagonal holds the reciprocal of the pivot.

    The three rows above stay in registers (a, b, c: nearest first; upper part and reciprocal pivot of each). Elimination of
    columns in the table takes twelve times as long.
    """
    a4, a5, a6, a_inv = L(J, 0.0), L(J, 0.0), L(J, 0.0), L(J, 0.0)
    b4, b5, b6, b_inv = L(J, 0.0), L(J, 0.0), L(J, 0.0), L(J, 0.0)
    c4, c5, c6, c_inv = L(J, 0.0), L(J, 0.0), L(J, 0.0), L(J, 0.0)
    for k in range(first, first + n2):
        l3 = J[BAND[0], k] * c_inv
        l2 = (J[BAND[1], k] - l3 * c4) * b_inv
        l1 = (J[BAND[2], k] - l3 * c5 - l2 * b4) * a_inv
        inv = reciprocal(J, J[BAND[3], k] - l3 * c6 - l2 * b5 - l1 * a4)
        u4 = J[BAND[4], k] - l2 * b6 - l1 * a5
        u5 = J[BAND[5], k] - l1 * a6
        u6 = J[BAND[6], k]
        J[BAND[0], k], J[BAND[1], k], J[BAND[2], k] = l3, l2, l1
        J[BAND[3], k], J[BAND[4], k], J[BAND[5], k] = inv, u4, u5
        c4, c5, c6, c_inv = b4, b5, b6, b_inv
        b4, b5, b6, b_inv = a4, a5, a6, a_inv
        a4, a5, a6, a_inv = u4, u5, u6, inv


@ti.kernel
def build_lines(J: ti.template(), G: Table, blocks: Blocks, count: ti.i32, near: LinearTable, inverse: LinearTable,
                alone: ti.template()):
    """Fill and factorise the bands of the first `count` blocks, after `classify`.

    near[2 l, m]: deflection at distance m along x on level l by a unit pressure; near[2 l + 1, m]: for the outermost row of a
    line contact, which continues to infinity. inverse[2 l, m], inverse[2 l + 1, m]: pressure in the own and in the next row by
    a unit film change.
    """
    ti.loop_config(block_dim=1, serialize=alone)
    for b in range(count):
        l, s = blocks[b, 0], blocks[b, 1]
        nx, ny, off = cells(G, l)
        first = off + s * (nx + 1)
        outer = L(J, 0.0)
        for u in ti.static(range(W)):
            if s * W + u == ny and int(G[l, JN]) == ny + 1:
                outer[u] = 1.0
        inner, own, beside = row_of(near, 2 * l), row_of(inverse, 2 * l), row_of(inverse, 2 * l + 1)
        rim = row_of(near, 2 * l + 1) - inner
        for i in range(nx + 1):
            fill_row(J, first + i, i, nx, inner, rim, own, beside, outer)
        factorise(J, first, nx + 1)


@ti.func
def substitute(J: ti.template(), first, n2):
    """Solve for SOL of one block, with RES as right-hand side."""
    y1, y2, y3 = L(J, 0.0), L(J, 0.0), L(J, 0.0)
    for i in range(n2):
        k = first + i
        y = J[RES, k] - J[BAND[0], k] * y3 - J[BAND[1], k] * y2 - J[BAND[2], k] * y1
        J[SOL, k] = y
        y3, y2, y1 = y2, y1, y
    y1, y2, y3 = L(J, 0.0), L(J, 0.0), L(J, 0.0)
    for r in range(n2):
        k = first + n2 - 1 - r
        y = (J[SOL, k] - J[BAND[4], k] * y1 - J[BAND[5], k] * y2 - J[BAND[6], k] * y3) * J[BAND[HALF], k]
        J[SOL, k] = y
        y3, y2, y1 = y2, y1, y


@ti.kernel
def export_rows(J: ti.template(), G: Table, l: ti.i32, out: LinearTable, alone: ti.template()):
    """Copy the Jacobian rows of level l: out[row of the stencil, node j (nx + 1) + i]."""
    nx, ny, off = cells(G, l)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            for n in range(ti.static(len(STENCIL))):
                v = J[STENCIL[0] + n, off + s * (nx + 1) + i]
                for u in ti.static(range(W)):
                    if s * W + u <= ny:
                        out[n, (s * W + u) * (nx + 1) + i] = v[u]
