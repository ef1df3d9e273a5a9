"""What the jobs of a linear solve do, each on one block of lanes or one group of waves; see :mod:`program`."""

import itertools

from tehl_taichi.engine.lanes import L, W, cells, lanes_in, lanes_out
from tehl_taichi.engine.language import ti
from tehl_taichi.pressure.convolution import LEVEL, M, along_x, along_y, rows_of_worker
from tehl_taichi.pressure.decisions import COUNT, DOT_SUM, INVERSE, LOAD_SUM, MASS_SUM, RISE, SCALARS, SQUARE_SUM, WEIGHTS
from tehl_taichi.pressure.fields import BD, BU, COR, FILM, RES, SCALE, SOL, TRIAL, B
from tehl_taichi.pressure.lines import DISTRIBUTED, DRY_KIND, LOCAL, is_kind, substitute
from tehl_taichi.pressure.program import (
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
from tehl_taichi.pressure.reynolds import reynolds_row
from tehl_taichi.pressure.transfer import prolong_block, restrict_block

COARSE_WEIGHT = 0.8  # of the coarser levels' sum: 30.1 Krylov iterations a step with 0.5, 22.9 with 0.8, 24.3 with 1 (256x64)
AT_ONCE = 4  # vectors of the basis that a loop over a block adds up
_row = itertools.count()
LIFTED, OUTFLOW, LOADING, BASIS = (next(_row) for _ in range(4))  # rows of the table of vectors: answer to a change of H0,
# weights of the rows in the net outflow, of the pressure in the load; the basis, then what the preconditioner makes of it


@ti.func
def block(G: ti.template(), s):
    """Columns of block s of the finest level: first and behind the last, in vectors; what the tables have in front."""
    nx, ny, off = cells(G, 0)
    return s * (nx + 1), (s + 1) * (nx + 1), off


@ti.func
def number(F: ti.template(), x):
    return ti.cast(x, F.J.dtype)


@ti.func
def sum_of(v):
    return ti.cast(v.sum(), ti.f64)


@ti.func
def start(F: ti.template(), G: ti.template(), partial: ti.template(), s, right: ti.template(), outflow: ti.template()):
    """First vector of the basis and right-hand side of the preconditioner, from the rows `right` (scaled)."""
    first, end, off = block(G, s)
    squares = L(F.J, 0.0)
    for q in range(first, end):
        x = lanes_in(right, q)
        F.V[BASIS, q], F.V[OUTFLOW, q], F.J[RES, off + q] = x, lanes_in(outflow, q), x * F.J[SCALE, off + q]
        squares += x * x
    partial[s, SQUARE_SUM] = sum_of(squares)


@ti.func
def ones(F: ti.template(), G: ti.template(), s):
    """RES = rows of the Jacobian for a film change of 1 everywhere."""
    first, end, off = block(G, s)
    for k in range(off + first, off + end):
        out = F.J[BU, k] + F.J[BD, k]
        for t in ti.static(range(4)):
            out += F.J[B[t], k]
        F.J[RES, k] = out


@ti.func
def dense(F: ti.template(), G: ti.template(), l, s):
    """COR of block s of the coarsest level: rows of its inverse, at the start of the field X, times RES."""
    nx, ny, off = cells(G, l)
    columns = (ny // W + 1) * (nx + 1)
    for q in range(s * (nx + 1), (s + 1) * (nx + 1)):
        parts = [L(F.J, 0.0) for _ in ti.static(range(W))]
        for p in range(columns):
            r = F.J[RES, off + p]
            for u in ti.static(range(W)):
                parts[u] += F.X[0, (q * columns + p) * W + u] * r[u]
        F.J[COR, off + q] = (parts[0] + parts[1]) + (parts[2] + parts[3])


@ti.func
def finest(F: ti.template(), G: ti.template(), partial: ti.template(), coarser, s):
    """COR of the finest level, complete, and its load."""
    if coarser > 0:
        prolong_block(F.J, G, 0, s, COARSE_WEIGHT)
    first, end, off = block(G, s)
    load = L(F.J, 0.0)
    for q in range(first, end):
        load += F.V[LOADING, q] * F.J[COR, off + q]
    partial[s, LOAD_SUM] = sum_of(load)


@ti.func
def lift(F: ti.template(), G: ti.template(), partial: ti.template(), s):
    """Keep the answer to a change of H0, where wet."""
    first, end, off = block(G, s)
    load = L(F.J, 0.0)
    for q in range(first, end):
        x = ti.select(is_kind(F.J, off + q, DRY_KIND), L(F.J, 0.0), F.J[COR, off + q])
        F.V[LIFTED, q] = x
        load += F.V[LOADING, q] * x
    partial[s, LOAD_SUM] = sum_of(load)


@ti.func
def distributed(F: ti.template(), C: ti.template(), G: ti.template(), c, s, w):
    """Line solution of a block; the rows of its distributed part."""
    nx, ny, off = cells(G, C[c, LEVEL])
    first, a = off + s * (nx + 1), rows_of_worker(C, w)
    substitute(F.J, first, nx + 1)
    for i in range(ti.min(nx + 1, 2 * C[c, M])):
        F.X[0, a + i] = ti.select(is_kind(F.J, first + i, DISTRIBUTED), F.J[SOL, first + i], L(F.J, 0.0))
    for i in range(nx + 1, 2 * C[c, M]):
        F.X[0, a + i] = L(F.J, 0.0)


@ti.func
def changes(F: ti.template(), C: ti.template(), G: ti.template(), N: ti.template(), s, w, most):
    """Newest direction: bordered correction of the finest level; its rows."""
    first, end, off = block(G, s)
    k, a = ti.cast(N[SCALARS, COUNT], ti.i32), rows_of_worker(C, w)
    scale, rise = number(F, N[INVERSE, k]), number(F, N[SCALARS, RISE])
    for q in range(first, end):
        z = F.J[COR, off + q] * scale - rise * F.V[LIFTED, q]
        F.V[BASIS + most + 1 + k, q], F.J[TRIAL, off + q], F.X[0, a + q - first] = z, z, z
    for i in range(end - first, 2 * C[0, M]):
        F.X[0, a + i] = L(F.J, 0.0)


@ti.func
def given(F: ti.template(), C: ti.template(), G: ti.template(), s, w, right: ti.template()):
    """A direction that somebody else chose."""
    first, end, off = block(G, s)
    a = rows_of_worker(C, w)
    for q in range(first, end):
        z = lanes_in(right, q)
        F.J[TRIAL, off + q], F.X[0, a + q - first] = z, z
    for i in range(end - first, 2 * C[0, M]):
        F.X[0, a + i] = L(F.J, 0.0)


@ti.func
def collect(F: ti.template(), C: ti.template(), G: ti.template(), c, s, x):
    """COR of a block from the rows at x: K^-1 of the distributed part, the line solution elsewhere, RES where dry."""
    nx, ny, off = cells(G, C[c, LEVEL])
    for i in range(nx + 1):
        k = off + s * (nx + 1) + i
        far = F.X[0, x + (i if i < 2 * C[c, M] else i - 2 * C[c, M])]
        z = ti.select(is_kind(F.J, k, LOCAL), F.J[SOL, k], far)
        F.J[COR, k] = ti.select(is_kind(F.J, k, DRY_KIND), F.J[RES, k], z)


@ti.func
def film(F: ti.template(), G: ti.template(), N: ti.template(), s, x):
    first, end, off = block(G, s)
    rise = L(F.J, N[SCALARS, RISE])
    for q in range(first, end):
        F.J[FILM, off + q] = F.X[0, x + q - first] + rise


@ti.func
def rows(F: ti.template(), G: ti.template(), N: ti.template(), partial: ti.template(), s):
    """Next vector of the basis: scaled rows of the Jacobian times the direction."""
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
    """Products of the newest vector with those before; AT_ONCE of them, further ones than there are go to nobody."""
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
    return number(F, N[WEIGHTS, i]) if i < count else number(F, 0.0)


@ti.func
def update(F: ti.template(), G: ti.template(), N: ti.template(), partial: ti.template(), s):
    """Newest vector less its components along the basis; the preconditioner's next right-hand side."""
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
    """The solution."""
    first, end, off = block(G, s)
    for q in range(first, end):
        x = L(F.J, 0.0)
        for i in range(ti.cast(N[SCALARS, COUNT], ti.i32)):
            x += number(F, N[WEIGHTS, i]) * F.V[BASIS + most + 1 + i, q]
        lanes_out(out, q, x)


@ti.func
def copy(F: ti.template(), G: ti.template(), N: ti.template(), s, out: ti.template()):
    """The newest vector."""
    first, end, off = block(G, s)
    for q in range(first, end):
        lanes_out(out, q, F.V[BASIS + ti.cast(N[SCALARS, COUNT], ti.i32) + 1, q])


@ti.func
def transformed(F: ti.template(), G: ti.template(), C: ti.template(), Q: ti.template(), N: ti.template(), operation, c, s, w,
                most, right: ti.template()):
    """What is transformed along x, there or back: one transform in the code serves all of them."""
    back = 1 if operation == COLLECT or operation == BACK else 0
    if operation == LINES:
        distributed(F, C, G, c, s, w)
    elif operation == FORWARD:
        changes(F, C, G, N, s, w, most)
    elif operation == GIVEN:
        given(F, C, G, s, w, right)
    x = along_x(F.X, F.Y, F.T, Q, C, c, s, w, back)
    if operation == COLLECT:
        collect(F, C, G, c, s, x)
    elif operation == BACK:
        film(F, G, N, s, x)


@ti.func
def vectors(F: ti.template(), G: ti.template(), N: ti.template(), partial: ti.template(), operation, a, s, most,
            right: ti.template(), outflow: ti.template(), out: ti.template()):
    """What works on the blocks of the finest level alone."""
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
    if operation == ROWS or operation == DOTS:
        dots(F, G, N, partial, s)


@ti.func
def work(F: ti.template(), G: ti.template(), C: ti.template(), Q: ti.template(), N: ti.template(), partial: ti.template(),
         operation, a, s, w, most, right: ti.template(), outflow: ti.template(), out: ti.template()):
    """One job, by worker w."""
    if operation == RESTRICT:
        restrict_block(F.J, G, a, s)
    elif operation == PROLONG:
        prolong_block(F.J, G, a, s, COARSE_WEIGHT)
    elif operation == DENSE:
        dense(F, G, a, s)
    elif operation == ACROSS:
        along_y(F.Y, F.T, Q, C, a, s, w)
    elif operation == LINES or operation == COLLECT or operation == FORWARD or operation == BACK or operation == GIVEN:
        transformed(F, G, C, Q, N, operation, a, s, w, most, right)
    else:
        vectors(F, G, N, partial, operation, a, s, most, right, outflow, out)
