"""Vector operations of a linear solve, one column per job; rows of V: :mod:`tehl_taichi.pressure.linear.operations`."""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import L, W, lanes_in, lanes_out
from tehl_taichi.pressure.fields import BD, BU, COR, FILM, KIND, RES, SCALE, TRIAL, B
from tehl_taichi.pressure.linear.blocks import number
from tehl_taichi.pressure.linear.cells.convolution import column, put_pair
from tehl_taichi.pressure.linear.cells.sizes import place
from tehl_taichi.pressure.linear.cells.sums import CHUNKS
from tehl_taichi.pressure.linear.gmres import COUNT, INVERSE, LOAD_SUM, RISE, SCALARS, WEIGHTS
from tehl_taichi.pressure.linear.line_solver import DRY_KIND, is_kind, kind_of
from tehl_taichi.pressure.linear.operations import BASIS, LIFTED, LOADING, OUTFLOW, change, corrected, distributed_part
from tehl_taichi.pressure.reynolds import reynolds_row


@ti.func
def classify(S: ti.template(), J: ti.template(), G: ti.template(), level: ti.template(), rest, narrow, wide):
    """Set KIND of every node of a level; bounds: :func:`tehl_taichi.pressure.linear.line_solver.classify`."""
    for q in range(level.columns):
        s, i = place(level, q)
        up, down = ti.Vector([0.0] * W), ti.Vector([0.0] * W)
        for u in ti.static(range(W)):
            up[u], down[u] = float(s * W + u + 1 < level.rows), float(s * W + u > 0)
        k = level.first + q
        J[KIND, k] = kind_of(S, J, G, level.number, k, level.n2, i, up, down, rest, narrow, wide)


@ti.func
def start(F: ti.template(), fine: ti.template(), right: ti.template(), outflow: ti.template()):
    """Set the first vector of the basis and the right-hand side of the preconditioner from the scaled rows `right`."""
    for q in range(fine.columns):
        x, k = lanes_in(right, q), fine.first + q
        F.V[BASIS, q], F.V[OUTFLOW, q], F.J[RES, k] = x, lanes_in(outflow, q), x * F.J[SCALE, k]


@ti.func
def ones(J: ti.template(), fine: ti.template()):
    """RES = rows of the Jacobian times a film change of 1 everywhere."""
    for k in range(fine.first, ti.static(fine.first + fine.columns)):
        out = J[BU, k] + J[BD, k]
        for t in ti.static(range(4)):
            out += J[B[t], k]
        J[RES, k] = out


@ti.func
def dense(J: ti.template(), D: ti.template(), level: ti.template()):
    """COR of the coarsest level: its inverse times RES."""
    for q in range(level.columns):
        out = L(J, 0.0)
        for p in range(level.columns):
            r = J[RES, level.first + p]
            for u in ti.static(range(W)):
                out += D[0, (q * level.columns + p) * W + u] * r[u]
        J[COR, level.first + q] = out


@ti.func
def put_columns(F: ti.template(), N: ti.template(), K: ti.template(), most: ti.template(), source: ti.template()):
    """Write the columns source(F, N, level, k, most), one of the next two functions, to the convolutions K."""
    for t in range(K.columns.total):
        for c, first, end in ti.static(K.columns.parts):
            if first <= t < end:
                s, m = (t - first) // c.M, (t - first) % c.M
                k, even, odd = c.level.first + s * c.level.n2 + 2 * m, L(F.J, 0.0), L(F.J, 0.0)
                if 2 * m < c.level.n2:
                    even = source(F, N, c.level, k, most)
                if 2 * m + 1 < c.level.n2:
                    odd = source(F, N, c.level, k + 1, most)
                put_pair(K, c, s, m, even, odd)


@ti.func
def line_part(F: ti.template(), N: ti.template(), level: ti.template(), k, most: ti.template()):
    """Distributed part of the line solutions in column k."""
    return distributed_part(F, k)


@ti.func
def directed(F: ti.template(), N: ti.template(), level: ti.template(), k, most: ti.template()):
    """Column k of the newest direction, which becomes the direction of the Jacobian."""
    count = ti.cast(N[SCALARS, COUNT], ti.i32)
    return change(F, level.first, k, BASIS + most + 1 + count, number(F, N[INVERSE, count]), number(F, N[SCALARS, RISE]))


@ti.func
def collect(F: ti.template(), K: ti.template(), lines: ti.template()):
    """Set COR of the levels with lines from their solutions and the result of the convolutions K."""
    for t in range(lines.columns.total):
        for n, part in ti.static(enumerate(lines.columns.parts)):
            one, first, end = ti.static(part)
            if first <= t < end:
                s, i = place(one, t - first)
                corrected(F, one.first + t - first, column(K, K.all[n], s, i))


@ti.func
def load_parts(F: ti.template(), fine: ti.template(), parts: ti.template()):
    """Partial sums of the load of COR."""
    for c in range(CHUNKS):
        out = ti.cast(0.0, ti.f64)
        for n in range(ti.static((fine.columns + CHUNKS - 1) // CHUNKS)):
            q = c + n * CHUNKS
            if q < fine.columns:
                out += ti.cast((F.V[LOADING, q] * F.J[COR, fine.first + q]).sum(), ti.f64)
        parts[LOAD_SUM, c] = out


@ti.func
def lift(F: ti.template(), fine: ti.template()):
    """Keep the preconditioner's answer to a change of H0 (0 at dry nodes), and set COR to it."""
    for q in range(fine.columns):
        k = fine.first + q
        x = ti.select(is_kind(F.J, k, DRY_KIND), L(F.J, 0.0), F.J[COR, k])
        F.V[LIFTED, q], F.J[COR, k] = x, x


@ti.func
def given(J: ti.template(), K: ti.template(), right: ti.template()):
    """Take a given direction `right`, and write it to the convolution K."""
    for t in range(K.columns.total):
        for c, first, end in ti.static(K.columns.parts):
            if first <= t < end:
                s, m = (t - first) // c.M, (t - first) % c.M
                q, even, odd = s * c.level.n2 + 2 * m, L(J, 0.0), L(J, 0.0)
                if 2 * m < c.level.n2:
                    even = lanes_in(right, q)
                    J[TRIAL, c.level.first + q] = even
                if 2 * m + 1 < c.level.n2:
                    odd = lanes_in(right, q + 1)
                    J[TRIAL, c.level.first + q + 1] = odd
                put_pair(K, c, s, m, even, odd)


@ti.func
def rows(F: ti.template(), N: ti.template(), K: ti.template(), fine: ti.template()):
    """Set FILM of the direction, then the next vector of the basis: scaled rows of the Jacobian times the direction."""
    for q in range(fine.columns):
        s, i = place(fine, q)
        F.J[FILM, fine.first + q] = column(K, K.all[0], s, i) + number(F, N[SCALARS, RISE])
    for q in range(fine.columns):
        k = fine.first + q
        F.V[BASIS + ti.cast(N[SCALARS, COUNT], ti.i32) + 1, q] = reynolds_row(F.J, k, fine.n2) / F.J[SCALE, k]


@ti.func
def update(F: ti.template(), N: ti.template(), fine: ti.template()):
    """Subtract the components along the basis from the newest vector, and set the preconditioner's next right-hand side."""
    for q in range(fine.columns):
        count = ti.cast(N[SCALARS, COUNT], ti.i32) + 1
        x = F.V[BASIS + count, q]
        for i in range(count):
            x -= number(F, N[WEIGHTS, i]) * F.V[BASIS + i, q]
        F.V[BASIS + count, q], F.J[RES, fine.first + q] = x, x * F.J[SCALE, fine.first + q]


@ti.func
def finish(F: ti.template(), N: ti.template(), fine: ti.template(), most: ti.template(), out: ti.template()):
    """Write the solution to `out`."""
    for q in range(fine.columns):
        x = L(F.J, 0.0)
        for i in range(ti.cast(N[SCALARS, COUNT], ti.i32)):
            x += number(F, N[WEIGHTS, i]) * F.V[BASIS + most + 1 + i, q]
        lanes_out(out, q, x)


@ti.func
def copy(F: ti.template(), N: ti.template(), fine: ti.template(), out: ti.template()):
    """Write the newest vector to `out`."""
    for q in range(fine.columns):
        lanes_out(out, q, F.V[BASIS + ti.cast(N[SCALARS, COUNT], ti.i32) + 1, q])
