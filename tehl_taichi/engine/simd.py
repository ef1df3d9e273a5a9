"""Lanes: W neighbours along y in one vector, so that every loop over x works on W rows at once (SIMD).

Measured on one core at 257x65 (scalar rows -> lanes): line solve 0.56 -> 0.13 ms, Jacobian product 0.95 -> 0.2 ms.

Loops over blocks run in parallel with ti.loop_config(block_dim=1): Taichi would give less than about 100 blocks to one thread.
The argument `alone` of a kernel is True if its loops are too short for that (see :meth:`Levels.launch`).

Kernels of the linear solve are written once for both precisions: they use the type of their table J, constants come from
:func:`L`, and arrays without a type take that of the argument.
"""

from tehl_taichi.engine.language import ti

# first columns of a table of grids, which loops over a grid read; further ones belong to who makes the table
OFF = 0  # first column of the grid in the tables
NX = 1  # cells along x
NY = 2  # cells along y (0: one-dimensional)
JN = 3  # rows that carry unknowns (NY + 1 for a line contact, NY for P = 0 at the outer row)

W = 4
V = ti.types.vector(W, ti.f64)
TILE = 48  # columns of a tile: even a single row keeps several threads busy

Table = ti.types.ndarray(dtype=ti.f64, ndim=2)
Flat = ti.types.ndarray(dtype=ti.f64, ndim=1)
LinearFlat = ti.types.ndarray(ndim=1)  # of the linear solve, in its precision
LinearTable = ti.types.ndarray(ndim=2)
Blocks = ti.types.ndarray(dtype=ti.i32, ndim=2)  # (level, block) of every block, finest level first


@ti.func
def L(J: ti.template(), value):
    """`value` in every lane, in the precision of the table J."""
    return ti.Vector([ti.cast(value, J.dtype) for _ in ti.static(range(W))])


@ti.func
def cells(G: ti.template(), l):
    return int(G[l, NX]), int(G[l, NY]), int(G[l, OFF])


@ti.func
def tiles(nx, ny):
    """Number of tiles of the finest level: pieces of blocks, for loops with enough work in each column."""
    return (ny // W + 1) * (nx // TILE + 1)


@ti.func
def tile(c, nx):
    """(block, first column, end column) of tile c."""
    per = nx // TILE + 1
    first = c % per * TILE
    return c // per, first, ti.min(first + TILE, nx + 1)


@ti.dataclass
class LaneBlock:
    """A block of rows at one x of the finest level."""

    k: ti.i32  # column in the tables of all levels
    q: ti.i32  # column in those of the finest level alone
    c: ti.i32  # number of its tile
    i: ti.i32  # along x
    s: ti.i32  # number of the block along y
    nx: ti.i32  # cells of the level
    ny: ti.i32


@ti.func
def block_at(G: ti.template(), c, i):
    """The LaneBlock at i along x in tile c."""
    nx, ny, off = cells(G, 0)
    s = tile(c, nx)[0]
    return LaneBlock(k=off + s * (nx + 1) + i, q=s * (nx + 1) + i, c=c, i=i, s=s, nx=nx, ny=ny)


@ti.func
def columns_around(at: ti.template(), q):
    """Column q in the blocks before and behind that of the place `at`; q itself if there is no such block."""
    n2 = at.nx + 1
    return q - (n2 if at.s > 0 else 0), q + (n2 if at.s < at.ny // W else 0)


@ti.func
def rows_around(at: ti.template(), here, before, behind):
    """Values at j - 1 and j + 1 of a block of rows, from it and the blocks before and behind; the value at j if there is no
    such row.
    """
    lower, upper = here, here
    for u in ti.static(range(W - 1)):
        lower[u + 1], upper[u] = here[u], here[u + 1]
    lower[0], upper[W - 1] = before[W - 1], behind[0]
    for u in ti.static(range(W)):  # chosen, not branched: that would keep what follows from vector instructions
        j = at.s * W + u
        lower[u], upper[u] = ti.select(j > 0, lower[u], here[u]), ti.select(j < at.ny, upper[u], here[u])
    return lower, upper


@ti.func
def repeated(values, s, ny):
    """Values of the rows of block s; rows beyond the last one repeat it."""
    last = values[W - 1]
    for u in ti.static(range(W)):
        last = ti.select(s * W + u == ny, values[u], last)
    for u in ti.static(range(W)):
        values[u] = ti.select(s * W + u <= ny, values[u], last)
    return values


@ti.func
def above(S: ti.template(), row, k, n2):
    """Field at j + 1."""
    out = S[row, k]
    for u in ti.static(range(W - 1)):
        out[u] = out[u + 1]
    out[W - 1] = S[row, k + n2][0]
    return out


@ti.func
def below(S: ti.template(), row, k, n2):
    """Field at j - 1."""
    out = S[row, k]
    for u in ti.static(range(W - 1, 0, -1)):
        out[u] = out[u - 1]
    out[0] = S[row, k - n2][W - 1]
    return out


@ti.func
def face_weights(s, ny):
    """Weights of the y fluxes at j + 1/2 and j - 1/2 in the balance of row j: mirrored at the first and the last row."""
    up, down = V(0.0), V(0.0)
    for u in ti.static(range(W)):
        j = s * W + u
        if j < ny:
            up[u] = 2.0 if j == 0 else 1.0
        if j > 0 and j <= ny:
            down[u] = 2.0 if j == ny else 1.0
    return up, down


@ti.func
def row_shares(s, ny):
    """Part of a cell along y for which each row of block s stands: half in the first and the last row, which are mirrors."""
    out = V(1.0)
    for u in ti.static(range(W)):
        if s * W + u == 0 or s * W + u == ny:
            out[u] = 0.5
    return out


@ti.func
def neighbour_masks(G: ti.template(), l, s):
    """Masks: 1 if row j + 1 (j - 1) exists among the unknowns."""
    up, down = V(0.0), V(0.0)
    for u in ti.static(range(W)):
        j = s * W + u
        if j + 1 < int(G[l, JN]):
            up[u] = 1.0
        if j > 0:
            down[u] = 1.0
    return up, down


@ti.func
def lanes_in(values: ti.template(), q):
    """Lanes of column q of a flat array in the order of the table."""
    return ti.Vector([values[q * W + u] for u in ti.static(range(W))])


@ti.func
def lanes_out(values: ti.template(), q, v):
    for u in ti.static(range(W)):
        values[q * W + u] = v[u]


@ti.kernel
def put(S: ti.template(), G: Table, l: ti.i32, row: ti.i32, values: Table, alone: ti.template()):
    """Copy values (ny+1, nx+1) to S[row] of level l; ghosts repeat the last row."""
    nx, ny, off = cells(G, l)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            v = V(0.0)
            for u in ti.static(range(W)):
                v[u] = values[ti.min(s * W + u, ny), i]
            S[row, off + s * (nx + 1) + i] = v


@ti.kernel
def get(S: ti.template(), G: Table, l: ti.i32, row: ti.i32, values: Table, alone: ti.template()):
    """Copy S[row] of level l to values (nx+1, ny+1), the orientation of stored steps."""
    nx, ny, off = cells(G, l)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            v = S[row, off + s * (nx + 1) + i]
            for u in ti.static(range(W)):
                if s * W + u <= ny:
                    values[i, s * W + u] = v[u]


def one_of(fields, field):
    """First arguments of :func:`fill` for one of these fields."""
    return fields, next(n for n, other in enumerate(fields) if other is field)


@ti.kernel
def fill(fields: ti.template(), which: ti.i32, row: ti.i32, first: ti.i32, values: LinearTable):
    """Set fields[which][row, first ...] = values (entries, lanes): one kernel for several fields, as each takes 12 ms to
    load.
    """
    for n in range(values.shape[0]):
        for k in ti.static(range(len(fields))):
            if which == k:
                for u in ti.static(range(fields[k].n)):
                    fields[k][row, first + n][u] = values[n, u]


@ti.kernel
def clear_ghosts(S: ti.template(), G: Table, row: ti.i32, last: ti.i32):
    """Set S[row] = 0 in the lanes beyond lane `last` of the last block of the finest level."""
    nx, ny, off = cells(G, 0)
    for i in range(nx + 1):
        for u in ti.static(range(W)):
            if u > last:
                S[row, off + ny // W * (nx + 1) + i][u] = 0.0
