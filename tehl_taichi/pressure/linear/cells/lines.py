"""Lines along x by cyclic reduction: three nodes are a block, the seven diagonals a block tridiagonal system.

Every step eliminates the neighbours at a distance from all blocks in parallel (factors A d^-1 and C d^-1, d: the neighbour's
own matrix) and doubles the distance. After the last step the blocks are independent. Lines of the gear on 256 columns: the
coupling is 1e-3 after three steps, 1e-7 after four. The error in single precision is 1e-7 of the largest value; with the
factors of :mod:`tehl_taichi.pressure.linear.line_solver` it is 5e-8.
"""

from tehl_taichi.engine import field_pool
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import L, W
from tehl_taichi.pressure.fields import BAND, RES, SOL
from tehl_taichi.pressure.linear.cells.sizes import Jobs, Level
from tehl_taichi.pressure.linear.line_solver import HALF, NEAR, REACH, fill_row

SIZE = 3  # nodes of a block, as many as the half bandwidth
ENTRIES = SIZE * SIZE
BEHIND, OWN, AHEAD = range(3)  # matrices of a block: of the block before it, its own, of the block after it
# rows of the field F: both states of these matrices; INVERSE: inverse of the own matrix at the end; RIGHT: both states of the
# right-hand side; STEPS: both factors of every step
INVERSE = 2 * 3 * ENTRIES
RIGHT = INVERSE + ENTRIES
STEPS = RIGHT + 2 * SIZE
SMALLEST = 1e-30  # least size of a determinant


class LineLevel(Level):
    """A level with lines.

    line_blocks: number of blocks of a line. first_block: first of its blocks in the field. inner, rim, inverse, beside: kernels
    of deflection and pressure near a node (see :func:`tehl_taichi.pressure.linear.line_solver.build_lines`).
    """

    def __init__(self, levels, number, first, inverse):
        super().__init__(levels, number)
        self.line_blocks, self.first_block = -(-self.n2 // SIZE), first
        near = levels.near_kernel(number, NEAR)
        self.inner, self.rim = (tuple(map(float, row[:REACH])) for row in (near[0], near[1] - near[0]))
        self.inverse, self.beside = (tuple(map(float, row[:REACH])) for row in inverse)
        self.outer = self.ny if self.rows == self.ny + 1 else -1  # row that continues for ever

    @property
    def lines(self):
        """Number of lines, ghosts included."""
        return self.blocks * W


class CyclicLines:
    """Lines of the levels with a distribution; symbols: of these distributions; F: field of the blocks of all lines."""

    def __init__(self, levels, symbols):
        self.levels, first = [], 0
        for one in symbols:
            self.levels.append(LineLevel(levels, one.shape.level, first, one.near(NEAR)))
            first += self.levels[-1].lines * self.levels[-1].line_blocks
        self.distances = [1 << n for n in range(max((one.line_blocks - 1).bit_length() for one in self.levels))]
        self.end = len(self.distances) % 2  # state of the matrices and right-hand sides behind the last step
        rows = STEPS + 2 * ENTRIES * len(self.distances)
        self.F = field_pool.lease(self, rows, 1, first, precision=levels.precision, clean=False)
        self.columns = Jobs([(one, one.columns) for one in self.levels])
        self.groups = Jobs([(one, one.blocks * one.line_blocks) for one in self.levels])  # of W blocks above each other
        self.blocks = Jobs([(one, one.lines * one.line_blocks) for one in self.levels])


@ti.func
def constants(J: ti.template(), row: ti.template()):
    """A vector of the numbers of `row`, as constants of the kernel."""
    return ti.Vector([ti.cast(ti.static(x), J.dtype) for x in ti.static(row)])


@ti.func
def fill_bands(J: ti.template(), lines: ti.template()):
    """Write the seven entries of every node's row."""
    for t in range(lines.columns.total):
        k, i, nx, outer = 0, 0, 0, L(J, 0.0)
        inner, rim = constants(J, lines.levels[0].inner), constants(J, lines.levels[0].rim)
        own, beside = constants(J, lines.levels[0].inverse), constants(J, lines.levels[0].beside)
        for one, first, end in ti.static(lines.columns.parts):
            if first <= t < end:
                s = (t - first) // one.n2
                k, i, nx = one.first + t - first, (t - first) % one.n2, one.nx
                inner, rim = constants(J, one.inner), constants(J, one.rim)
                own, beside = constants(J, one.inverse), constants(J, one.beside)
                for u in ti.static(range(W)):
                    if s * W + u == one.outer:
                        outer[u] = ti.cast(1.0, J.dtype)
        fill_row(J, k, i, nx, inner, rim, own, beside, outer)


@ti.func
def group(lines: ti.template(), t):
    """(k, nodes, q, step) of job t of `lines.groups`, the blocks of W lines at one place.

    k: column of their first nodes in the tables; nodes: number of nodes of a line from there on; q: number of the first block;
    step: distance of the blocks from line to line.
    """
    k, nodes, q, step = 0, 0, 0, 0
    for one, first, end in ti.static(lines.groups.parts):
        if first <= t < end:
            s, b = (t - first) // one.line_blocks, (t - first) % one.line_blocks
            k, nodes = one.first + s * one.n2 + b * SIZE, one.n2 - b * SIZE
            q, step = one.first_block + s * W * one.line_blocks + b, one.line_blocks
    return k, nodes, q, step


@ti.func
def neighbours(lines: ti.template(), q, distance):
    """Whether block q has neighbours at a distance: (before it, after it)."""
    behind, ahead = False, False
    for one, first, end in ti.static(lines.blocks.parts):
        if first <= q < end:
            b = (q - first) % one.line_blocks
            behind, ahead = b >= distance, b + distance < one.line_blocks
    return behind, ahead


@ti.func
def matrix(F: ti.template(), row, b):
    """Matrix of block b that begins at `row` of the field."""
    return ti.Matrix([[F[row + SIZE * r + c, b][0] for c in ti.static(range(SIZE))] for r in ti.static(range(SIZE))])


@ti.func
def put_matrix(F: ti.template(), row, b, m):
    """Store a matrix of block b from `row` of the field on."""
    for r, c in ti.static(ti.ndrange(SIZE, SIZE)):
        F[row + SIZE * r + c, b][0] = m[r, c]


@ti.func
def inverted(F: ti.template(), m):
    """Inverse by cofactors."""
    a, b = m[1, 1] * m[2, 2] - m[1, 2] * m[2, 1], m[1, 2] * m[2, 0] - m[1, 0] * m[2, 2]
    c = m[1, 0] * m[2, 1] - m[1, 1] * m[2, 0]
    det, tiny = m[0, 0] * a + m[0, 1] * b + m[0, 2] * c, ti.cast(SMALLEST, F.dtype)
    inv = ti.cast(1.0, F.dtype) / ti.select(ti.abs(det) < tiny, tiny, det)
    return inv * ti.Matrix([[a, m[0, 2] * m[2, 1] - m[0, 1] * m[2, 2], m[0, 1] * m[1, 2] - m[0, 2] * m[1, 1]],
                            [b, m[0, 0] * m[2, 2] - m[0, 2] * m[2, 0], m[0, 2] * m[1, 0] - m[0, 0] * m[1, 2]],
                            [c, m[0, 1] * m[2, 0] - m[0, 0] * m[2, 1], m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]]])


@ti.func
def state(n, which: ti.template()):
    """First row of the field for the matrix `which` (BEHIND, OWN, AHEAD) in state n, 0 or 1."""
    return (3 * n + which) * ENTRIES


@ti.func
def gather(J: ti.template(), lines: ti.template()):
    """Set the matrices of all blocks from the bands; nodes after the last one are the identity."""
    F = ti.static(lines.F)
    for t in range(lines.groups.total):
        k, nodes, q, step = group(lines, t)
        for r, m in ti.static(ti.ndrange(SIZE, 3 * SIZE)):  # m: node, from the first of the block behind
            band = ti.static(m - SIZE - r + HALF)
            v = L(F, ti.static(1.0 if band == HALF else 0.0))
            if ti.static(0 <= band <= 2 * HALF):
                if r < nodes:
                    v = J[BAND[band], k + r]
            for u in ti.static(range(W)):
                F[ti.static(m // SIZE * ENTRIES + SIZE * r + m % SIZE), q + u * step][0] = v[u]


@ti.func
def eliminate(F: ti.template(), d, old, new, q, other, row, side: ti.template(), here):
    """Eliminate the neighbour `other` on a side (BEHIND or AHEAD) from block q; return the new own matrix.

    d: own matrix of q; old, new: states; row: where the factor is stored; here: whether the neighbour exists.
    """
    factor, beyond = d * ti.cast(0.0, F.dtype), d * ti.cast(0.0, F.dtype)
    if here:
        factor = matrix(F, state(old, side), q) @ inverted(F, matrix(F, state(old, OWN), other))
        d -= factor @ matrix(F, state(old, ti.static(2 - side)), other)
        beyond = -factor @ matrix(F, state(old, side), other)
    put_matrix(F, row, q, factor)
    put_matrix(F, state(new, side), q, beyond)
    return d


@ti.func
def reduce_matrices(lines: ti.template(), n):
    """Step n of the reduction: compute its factors and the new matrices."""
    F = ti.static(lines.F)
    for q in range(lines.blocks.total):
        distance, old, row = 1 << n, n % 2, STEPS + 2 * n * ENTRIES
        behind, ahead = neighbours(lines, q, distance)
        d = matrix(F, state(old, OWN), q)
        d = eliminate(F, d, old, 1 - old, q, q - distance, row, BEHIND, behind)
        d = eliminate(F, d, old, 1 - old, q, q + distance, row + ENTRIES, AHEAD, ahead)
        put_matrix(F, state(1 - old, OWN), q, d)


@ti.func
def invert(lines: ti.template()):
    """Invert the own matrices of the blocks, which are independent after the last step."""
    F = ti.static(lines.F)
    for q in range(lines.blocks.total):
        put_matrix(F, INVERSE, q, inverted(F, matrix(F, state(lines.end, OWN), q)))


@ti.func
def right_row(n: ti.template(), r: ti.template()):
    """Row of the field with entry r of the right-hand side in state n."""
    return ti.static(RIGHT + SIZE * n + r)


@ti.func
def right(F: ti.template(), n: ti.template(), q):
    """Right-hand side (SIZE,) of block q in state n."""
    return ti.Vector([F[right_row(n, r), q][0] for r in ti.static(range(SIZE))])


@ti.func
def take_right(J: ti.template(), lines: ti.template()):
    """Set the right-hand sides of all blocks from RES."""
    F = ti.static(lines.F)
    for t in range(lines.groups.total):
        k, nodes, q, step = group(lines, t)
        for r in ti.static(range(SIZE)):
            v = L(F, 0.0)
            if r < nodes:
                v = J[RES, k + r]
            for u in ti.static(range(W)):
                F[right_row(0, r), q + u * step][0] = v[u]


@ti.func
def reduce_right(lines: ti.template(), n: ti.template()):
    """Step n of the reduction of the right-hand sides."""
    F, distance = ti.static(lines.F, lines.distances[n])
    for q in range(lines.blocks.total):
        behind, ahead = neighbours(lines, q, distance)
        x = right(F, ti.static(n % 2), q)
        if behind:
            x -= matrix(F, ti.static(STEPS + 2 * n * ENTRIES), q) @ right(F, ti.static(n % 2), q - distance)
        if ahead:
            x -= matrix(F, ti.static(STEPS + (2 * n + 1) * ENTRIES), q) @ right(F, ti.static(n % 2), q + distance)
        for r in ti.static(range(SIZE)):
            F[right_row(ti.static(1 - n % 2), r), q][0] = x[r]


@ti.func
def solve(J: ti.template(), lines: ti.template()):
    """Solve all lines for SOL, with RES as right-hand side."""
    take_right(J, lines)
    for n in ti.static(range(len(lines.distances))):
        reduce_right(lines, n)
    F = ti.static(lines.F)
    for q in range(lines.blocks.total):
        x = matrix(F, INVERSE, q) @ right(F, lines.end, q)
        for r in ti.static(range(SIZE)):
            F[right_row(lines.end, r), q][0] = x[r]
    for t in range(lines.groups.total):
        k, nodes, q, step = group(lines, t)
        for r in ti.static(range(SIZE)):
            if r < nodes:
                J[SOL, k + r] = ti.Vector([F[right_row(lines.end, r), q + u * step][0] for u in ti.static(range(W))])
