"""Operations of a linear solve. A job is an operation on one block of W rows, or on one group of waves; see :mod:`schedule`."""

import itertools

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import L, W, cells, lanes_in, lanes_out
from tehl_taichi.pressure.fields import BD, BU, COR, FILM, RES, SCALE, SOL, TRIAL, B
from tehl_taichi.pressure.linear import convolution, red_black
from tehl_taichi.pressure.linear.blocks import block, number, take
from tehl_taichi.pressure.linear.convolution import LEVEL, M, buffer, clear, first_of, pair, second_of, side_by_side
from tehl_taichi.pressure.linear.gmres import COUNT, DOT_SUM, INVERSE, LOAD_SUM, MASS_SUM, RISE, SCALARS, SQUARE_SUM, WEIGHTS
from tehl_taichi.pressure.linear.line_solver import DISTRIBUTED, DRY_KIND, LOCAL, is_kind, substitute
from tehl_taichi.pressure.linear.schedule import (
    ACROSS,
    BACK,
    COLLECT,
    COPY,
    DENSE,
    DOTS,
    FINEST,
    FINISH,
    FORWARD,
    GIVEN,
    LIFT,
    LINES,
    ONES,
    PROLONG,
    RESTRICT,
    ROWS,
    START,
    UPDATE,
)
from tehl_taichi.pressure.linear.transfer import prolong_block, restrict_block
from tehl_taichi.pressure.reynolds import reynolds_row

# weight of the correction of the coarser levels. Krylov iterations per step on 256x64 cells: 30.1 with 0.5, 22.9 with 0.8, 24.3
# with 1
COARSE_WEIGHT = 0.8
AT_ONCE = 4  # vectors of the basis in one loop over a block
_row = itertools.count()
# rows of the table of vectors: the preconditioner's answer to a change of H0, weights of the rows in the net outflow, weights
# of the pressure in the load; first vector of the basis, after which the preconditioned vectors follow
LIFTED, OUTFLOW, LOADING, BASIS = (next(_row) for _ in range(4))


@ti.func
def sum_of(v):
    """Sum of the lanes, in double precision."""
    return ti.cast(v.sum(), ti.f64)


@ti.func
def start(F: ti.template(), G: ti.template(), partial: ti.template(), s, right: ti.template(), outflow: ti.template()):
    """Set the first vector of the basis and the right-hand side of the preconditioner from the scaled rows `right`."""
    first, end, off = block(G, s)
    squares = L(F.J, 0.0)
    for q in range(first, end):
        x = lanes_in(right, q)
        F.V[BASIS, q], F.V[OUTFLOW, q], F.J[RES, off + q] = x, lanes_in(outflow, q), x * F.J[SCALE, off + q]
        squares += x * x
    partial[s, SQUARE_SUM] = sum_of(squares)


@ti.func
def ones(F: ti.template(), G: ti.template(), s):
    """RES = rows of the Jacobian times a film change of 1 everywhere."""
    first, end, off = block(G, s)
    for k in range(off + first, off + end):
        out = F.J[BU, k] + F.J[BD, k]
        for t in ti.static(range(4)):
            out += F.J[B[t], k]
        F.J[RES, k] = out


@ti.func
def dense(F: ti.template(), G: ti.template(), l, s):
    """COR of block s of the coarsest level: rows of its inverse (field D) times RES."""
    nx, ny, off = cells(G, l)
    columns = (ny // W + 1) * (nx + 1)
    for q in range(s * (nx + 1), (s + 1) * (nx + 1)):
        parts = [L(F.J, 0.0) for _ in ti.static(range(W))]
        for p in range(columns):
            r = F.J[RES, off + p]
            for u in ti.static(range(W)):
                parts[u] += F.D[0, (q * columns + p) * W + u] * r[u]
        F.J[COR, off + q] = (parts[0] + parts[1]) + (parts[2] + parts[3])


@ti.func
def finest(F: ti.template(), G: ti.template(), partial: ti.template(), coarser, s):
    """Add the coarser levels (if any) to COR of the finest level; sum up its load."""
    if coarser > 0:
        prolong_block(F.J, G, 0, s, COARSE_WEIGHT)
    first, end, off = block(G, s)
    load = L(F.J, 0.0)
    for q in range(first, end):
        load += F.V[LOADING, q] * F.J[COR, off + q]
    partial[s, LOAD_SUM] = sum_of(load)


@ti.func
def lift(F: ti.template(), G: ti.template(), partial: ti.template(), s):
    """Keep the preconditioner's answer to a change of H0 (0 at dry nodes), and its load."""
    first, end, off = block(G, s)
    load = L(F.J, 0.0)
    for q in range(first, end):
        x = ti.select(is_kind(F.J, off + q, DRY_KIND), L(F.J, 0.0), F.J[COR, off + q])
        F.V[LIFTED, q] = x
        load += F.V[LOADING, q] * x
    partial[s, LOAD_SUM] = sum_of(load)


@ti.func
def distributed_part(F: ti.template(), k):
    """SOL of column k where the unknown is distributed, else 0."""
    return ti.select(is_kind(F.J, k, DISTRIBUTED), F.J[SOL, k], L(F.J, 0.0))


@ti.func
def distributed(F: ti.template(), C: ti.template(), G: ti.template(), c, j, w, operation):
    """Solve the lines of a pair of blocks (of one colour, or all) and write their distributed part to the buffer."""
    first, second, n2 = pair(G, C[c, LEVEL], j)
    a, period = buffer(C, w), 2 * C[c, M]
    for h in range(2 if second > first else 1):
        substitute(F.J, first + h * n2, n2)
        if ti.static(F.colours):
            if operation != LINES:
                red_black.keep_colour(F, first + h * n2, n2, operation)
    for i in range(ti.min(n2, period)):
        F.Y[0, a + i] = side_by_side(distributed_part(F, first + i), distributed_part(F, second + i))
    clear(F.Y, a + n2, a + period)


@ti.func
def change(F: ti.template(), off, k, n, scale, rise):
    """Column k of the newest direction, row n of the vectors: correction of the finest level with the border (change of H0)."""
    z = F.J[COR, k] * scale - rise * F.V[LIFTED, k - off]
    F.V[n, k - off], F.J[TRIAL, k] = z, z
    return z


@ti.func
def changes(F: ti.template(), C: ti.template(), G: ti.template(), N: ti.template(), j, w, most):
    """Compute the newest direction of a pair of blocks and write it to the buffer."""
    first, second, n2 = pair(G, 0, j)
    off = cells(G, 0)[2]
    k, a = ti.cast(N[SCALARS, COUNT], ti.i32), buffer(C, w)
    scale, rise = number(F, N[INVERSE, k]), number(F, N[SCALARS, RISE])
    for i in range(n2):
        z = change(F, off, second + i, BASIS + most + 1 + k, scale, rise)
        F.Y[0, a + i] = side_by_side(change(F, off, first + i, BASIS + most + 1 + k, scale, rise), z)
    clear(F.Y, a + n2, a + 2 * C[0, M])


@ti.func
def given(F: ti.template(), C: ti.template(), G: ti.template(), j, w, right: ti.template()):
    """Take a given direction `right` of a pair of blocks, and write it to the buffer."""
    first, second, n2 = pair(G, 0, j)
    a, off = buffer(C, w), cells(G, 0)[2]
    for i in range(n2):
        take(F, first + i, second + i, a + i, lanes_in(right, first + i - off), lanes_in(right, second + i - off))
    clear(F.Y, a + n2, a + 2 * C[0, M])


@ti.func
def corrected(F: ti.template(), k, far):
    """COR of column k: `far` (K^-1 of the distributed part), the line solution at local nodes, RES at dry nodes."""
    z = ti.select(is_kind(F.J, k, LOCAL), F.J[SOL, k], far)
    F.J[COR, k] = ti.select(is_kind(F.J, k, DRY_KIND), F.J[RES, k], z)


@ti.func
def collect(F: ti.template(), C: ti.template(), G: ti.template(), c, j, x):
    """COR of a pair of blocks from the rows that begin at entry x of Y."""
    first, second, n2 = pair(G, C[c, LEVEL], j)
    for i in range(n2):
        far = F.Y[0, x + (i if i < 2 * C[c, M] else i - 2 * C[c, M])]
        corrected(F, second + i, second_of(far))
        corrected(F, first + i, first_of(far))


@ti.func
def film(F: ti.template(), G: ti.template(), j, x, change):
    """FILM of a pair of blocks from the rows that begin at entry x of Y, plus a `change` of H0."""
    first, second, n2 = pair(G, 0, j)
    rise = L(F.J, change)
    for i in range(n2):
        bent = F.Y[0, x + i]
        F.J[FILM, second + i] = second_of(bent) + rise
        F.J[FILM, first + i] = first_of(bent) + rise


@ti.func
def rows(F: ti.template(), G: ti.template(), N: ti.template(), partial: ti.template(), s):
    """Compute the next vector of the basis: scaled rows of the Jacobian times the direction."""
    first, end, off = block(G, s)
    n2, new = end - first, BASIS + ti.cast(N[SCALARS, COUNT], ti.i32) + 1
    squares, mass = L(F.J, 0.0), L(F.J, 0.0)
    for q in range(first, end):
        x = reynolds_row(F.J, off + q, n2) / F.J[SCALE, off + q]
        F.V[new, q] = x
        squares += x * x
        mass += F.V[OUTFLOW, q] * x
    partial[s, SQUARE_SUM], partial[s, MASS_SUM] = sum_of(squares), sum_of(mass)


@ti.func
def dots(F: ti.template(), G: ti.template(), N: ti.template(), partial: ti.template(), s):
    """Products of the newest vector with all before it, AT_ONCE in a loop; surplus products are ignored."""
    first, end, off = block(G, s)
    k = ti.cast(N[SCALARS, COUNT], ti.i32)
    for n in range((k + AT_ONCE) // AT_ONCE):
        i = n * AT_ONCE
        sums = [L(F.J, 0.0) for _ in ti.static(range(AT_ONCE))]
        for q in range(first, end):
            x = F.V[BASIS + k + 1, q]
            for t in ti.static(range(AT_ONCE)):
                sums[t] += F.V[BASIS + i + t, q] * x
        for t in ti.static(range(AT_ONCE)):
            partial[s, DOT_SUM + i + t] = sum_of(sums[t])


@ti.func
def weight(F: ti.template(), N: ti.template(), i, count):
    """Weight of vector i, 0 from `count` on."""
    return number(F, N[WEIGHTS, i]) if i < count else number(F, 0.0)


@ti.func
def update(F: ti.template(), G: ti.template(), N: ti.template(), partial: ti.template(), s):
    """Subtract the components along the basis from the newest vector, and set the preconditioner's next right-hand side."""
    first, end, off = block(G, s)
    count = ti.cast(N[SCALARS, COUNT], ti.i32) + 1
    new = BASIS + count
    for n in range((count + AT_ONCE - 1) // AT_ONCE):
        i = n * AT_ONCE
        h = [weight(F, N, i + t, count) for t in ti.static(range(AT_ONCE))]
        for q in range(first, end):
            x = F.V[new, q]
            for t in ti.static(range(AT_ONCE)):
                x -= h[t] * F.V[BASIS + ti.min(i + t, count - 1), q]
            F.V[new, q] = x
    squares = L(F.J, 0.0)
    for q in range(first, end):
        x = F.V[new, q]
        F.J[RES, off + q] = x * F.J[SCALE, off + q]
        squares += x * x
    partial[s, SQUARE_SUM] = sum_of(squares)


@ti.func
def finish(F: ti.template(), G: ti.template(), N: ti.template(), s, most, out: ti.template()):
    """Write the solution to `out`."""
    first, end, off = block(G, s)
    for q in range(first, end):
        x = L(F.J, 0.0)
        for i in range(ti.cast(N[SCALARS, COUNT], ti.i32)):
            x += number(F, N[WEIGHTS, i]) * F.V[BASIS + most + 1 + i, q]
        lanes_out(out, q, x)


@ti.func
def copy(F: ti.template(), G: ti.template(), N: ti.template(), s, out: ti.template()):
    """Write the newest vector to `out`."""
    first, end, off = block(G, s)
    for q in range(first, end):
        lanes_out(out, q, F.V[BASIS + ti.cast(N[SCALARS, COUNT], ti.i32) + 1, q])


@ti.func
def transformed(F: ti.template(), G: ti.template(), C: ti.template(), Q: ti.template(), N: ti.template(), operation, c, j, w,
                most, right: ti.template()):
    """Do the transforms of an operation, with the work before and after them."""
    way = convolution.THERE
    if operation == ACROSS:
        way = convolution.ACROSS
    elif operation == COLLECT or operation == BACK or operation == red_black.BENT:
        way = convolution.BACK
    elif operation == LINES or operation == red_black.RED or operation == red_black.BLACK:
        distributed(F, C, G, c, j, w, operation)
    elif operation == FORWARD:
        changes(F, C, G, N, j, w, most)
    elif operation == GIVEN:
        given(F, C, G, j, w, right)
    if ti.static(F.colours):
        if operation == red_black.SPREAD:
            red_black.spread(F, C, G, j, w)
    x = convolution.transformed(F.Y, F.T, Q, F.odd, C, c, j, w, way)
    if operation == COLLECT:
        collect(F, C, G, c, j, x)
    elif operation == BACK or operation == red_black.BENT:
        film(F, G, j, x, N[SCALARS, RISE] if operation == BACK else 0.0)


@ti.func
def vectors(F: ti.template(), G: ti.template(), N: ti.template(), partial: ti.template(), operation, a, s, most,
            right: ti.template(), outflow: ti.template(), out: ti.template()):
    """Do a vector operation on block s of the finest level."""
    if operation == START:
        start(F, G, partial, s, right, outflow)
    elif operation == FINEST:
        finest(F, G, partial, a, s)
    elif operation == ROWS:
        rows(F, G, N, partial, s)
    elif operation == UPDATE:
        update(F, G, N, partial, s)
    elif operation == FINISH:
        finish(F, G, N, s, most, out)
    elif operation == ONES:
        ones(F, G, s)
    elif operation == LIFT:
        lift(F, G, partial, s)
    elif operation == COPY:
        copy(F, G, N, s, out)
    if ti.static(F.colours):
        if operation == red_black.LEFT:
            red_black.left(F, G, s)
        elif operation == red_black.ADDED:
            red_black.add_first_colour(F, G, s)
            finest(F, G, partial, 0, s)
    if operation == ROWS or operation == DOTS:
        dots(F, G, N, partial, s)


@ti.func
def work(F: ti.template(), G: ti.template(), C: ti.template(), Q: ti.template(), N: ti.template(), partial: ti.template(),
         operation, a, s, w, most, right: ti.template(), outflow: ti.template(), out: ti.template()):
    """Do one job (operation, a: level or convolution, s: block, pair or group), as worker w."""
    if operation == RESTRICT:
        restrict_block(F.J, G, a, s)
    elif operation == PROLONG:
        prolong_block(F.J, G, a, s, COARSE_WEIGHT)
    elif operation == DENSE:
        dense(F, G, a, s)
    elif (operation == LINES or operation == ACROSS or operation == COLLECT or operation == FORWARD or operation == BACK
          or operation == GIVEN or operation == red_black.RED or operation == red_black.BLACK or operation == red_black.SPREAD
          or operation == red_black.BENT):
        transformed(F, G, C, Q, N, operation, a, s, w, most, right)
    else:
        vectors(F, G, N, partial, operation, a, s, most, right, outflow, out)
