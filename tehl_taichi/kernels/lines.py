"""Line solver along x: one small banded system (7 diagonals) per row, all rows at once.

Two kinds of columns. Where the Poiseuille part is strong a node is changed by itself ("Gauss-Seidel" column: the local
part of the deflection kernel is in the matrix). In the high-pressure zone eps is about 1e-10 and the equation is pure
transport of rho H: there the unknown is distributed with K^-1 (symbol |k|, one unpadded FFT), so that its film change is
a unit at one node and the rows become banded transport.
"""

import taichi as ti

from tehl_taichi.kernels.fields import (
    COR,
    CT,
    CX,
    CY,
    DRY,
    EX,
    EY,
    JN,
    K0,
    KIND,
    NX,
    OFF,
    PERIOD,
    QP,
    RES,
    RHO,
    SOL,
    SPREAD,
    TOUCH,
)
from tehl_taichi.kernels.reynolds import Flat, Rows, Table, cells, couette_weight

HALF = 3  # half bandwidth; 2 converges slower, 1 diverges, 4..6 gain nothing
TINY_PIVOT = 1e-14


@ti.func
def kind_of(S: ti.template(), G: ti.template(), l, k, i, j, theta):
    nx, ny, off = cells(G, l)
    eps = S[EX, k] + S[EX, k - 1]
    if j < ny:
        eps += S[EY, k] * (2.0 if j == 0 else 1.0)
    if j > 0:
        eps += S[EY, k - nx - 1]
    jn = int(G[l, JN])
    strong = eps > theta * G[l, K0] * (0.5 + G[l, CT]) or i == 1 or i == nx - 1
    strong = strong or S[DRY, k - 1] + S[DRY, k + 1] > 0
    if j > 0:
        strong = strong or S[DRY, k - nx - 1] > 0
    if j + 1 < jn:
        strong = strong or S[DRY, k + nx + 1] > 0
    kind = 2.0
    if strong and S[TOUCH, k] == 0.0:
        kind = 1.0
    return kind


@ti.func
def weight(G: ti.template(), l, i, t):
    return couette_weight(i, t) + (G[l, CT] if t == 0 else 0.0)


@ti.func
def local_part(S: ti.template(), G: ti.template(), l, k, i, j):
    """Entries of a Reynolds row that do not come from the deflection: columns i-2..i+1, row above, row below."""
    nx, ny, off = cells(G, l)
    n2 = nx + 1
    a = ti.Vector([0.0] * 6)
    for t in ti.static(range(-2, 2)):
        if i + t >= 0:
            a[t + 2] = weight(G, l, i, t) * S[QP, k + t]
    a[3] -= S[CX[1], k]
    a[2] += S[CX[1], k - 1] - S[CX[0], k]
    a[1] += S[CX[0], k - 1]
    if j < ny:
        s = 2.0 if j == 0 else 1.0
        a[2] -= s * S[CY[0], k]
        a[4] -= s * S[CY[1], k]
    if j > 0:
        a[2] += S[CY[1], k - n2]
        a[5] += S[CY[0], k - n2]
    return a


@ti.func
def film_part(S: ti.template(), G: ti.template(), l, k, i, dk, gs, self_kernel: ti.template(), m_row):
    """Transport of the film change that column i+dk causes, at row i."""
    nx = cells(G, l)[0]
    v = 0.0
    for t in ti.static(range(-2, 2)):
        if i + t >= 0 and i + t <= nx and (S[TOUCH, k] == 0.0 or S[TOUCH, k + t] == 1.0):
            m = abs(t - dk)
            h = 1.0 if m == 0 else 0.0
            if gs:
                h = self_kernel[m_row, m]
            v += weight(G, l, i, t) * S[RHO, k + t] * h
    return v


@ti.func
def entry(S: ti.template(), G: ti.template(), l, k, i, dk, a, near: ti.template(), m_row, inverse: ti.template()):
    """Matrix entry of row i, column i + dk."""
    gs = S[KIND, k + dk] == 1.0
    v = film_part(S, G, l, k, i, dk, gs, near, m_row)
    if S[TOUCH, k] == 0.0:
        for t in ti.static(range(-2, 2)):
            if gs:
                if t == dk:
                    v += a[t + 2]
            else:
                v += a[t + 2] * inverse[2 * l, abs(t - dk)]
        if not gs:
            v += (a[4] + a[5]) * inverse[2 * l + 1, abs(dk)]
    return v


@ti.func
def factorise(B: ti.template(), first, n2):
    """LU without pivoting of the banded row, in place."""
    for i in range(n2):
        pivot = B[first + i, HALF]
        if abs(pivot) < TINY_PIVOT:
            pivot = TINY_PIVOT
            B[first + i, HALF] = pivot
        for s in range(1, HALF + 1):
            if i + s < n2:
                g = B[first + i + s, HALF - s] / pivot
                B[first + i + s, HALF - s] = g
                for q in range(1, HALF + 1):
                    if i + q < n2:
                        B[first + i + s, HALF - s + q] -= g * B[first + i, HALF + q]


@ti.kernel
def classify(S: Table, G: Table, rows: Rows, count: ti.i32, theta: ti.f64):
    """KIND of every node in the first `count` grid rows."""
    for r in range(count):
        l, j = rows[r, 0], rows[r, 1]
        nx, ny, off = cells(G, l)
        for i in range(nx + 1):
            k = off + j * (nx + 1) + i
            S[KIND, k] = 0.0
            if S[DRY, k] == 0.0:
                S[KIND, k] = kind_of(S, G, l, k, i, j, theta)


@ti.func
def fill_row(S: ti.template(), G: ti.template(), l, k, i, j, B: ti.template(), near: ti.template(),
             inverse: ti.template()):
    """The seven entries of one wet node; columns without an unknown stay empty."""
    nx, ny, off = cells(G, l)
    table = 2 * l
    if j == ny and int(G[l, JN]) == ny + 1:
        table += 1
    a = local_part(S, G, l, k, i, j)
    for b in range(2 * HALF + 1):
        dk = b - HALF
        B[k, b] = 0.0
        if i + dk > 0 and i + dk < nx:
            if S[KIND, k + dk] > 0.0:
                B[k, b] = entry(S, G, l, k, i, dk, a, near, table, inverse)


@ti.kernel
def build_lines(S: Table, G: Table, rows: Rows, count: ti.i32, B: Table, near: Table, inverse: Table):
    """Fill and factorise the bands B[node, 0..6] of the first `count` grid rows; needs `classify`.

    near[2 l + (0 or 1), m]: deflection at distance m in x on level l (1: the outermost row of a line contact, which
    goes on to infinity); inverse[2 l + (0 or 1), m]: pressure of a unit film change, in its own and in the next row.
    """
    for r in range(count):
        l, j = rows[r, 0], rows[r, 1]
        nx, ny, off = cells(G, l)
        n2 = nx + 1
        for i in range(n2):
            k = off + j * n2 + i
            if S[DRY, k] == 0.0:
                fill_row(S, G, l, k, i, j, B, near, inverse)
            else:
                for b in range(2 * HALF + 1):
                    B[k, b] = 1.0 if b == HALF else 0.0
        factorise(B, off + j * n2, n2)


@ti.func
def substitute(S: ti.template(), B: ti.template(), first, n2):
    for i in range(n2):
        s = S[RES, first + i]
        for b in range(HALF):
            if i - HALF + b >= 0:
                s -= B[first + i, b] * S[SOL, first + i - HALF + b]
        S[SOL, first + i] = s
    for r in range(n2):
        i = n2 - 1 - r
        s = S[SOL, first + i]
        for b in range(HALF + 1, 2 * HALF + 1):
            if i - HALF + b < n2:
                s -= B[first + i, b] * S[SOL, first + i - HALF + b]
        S[SOL, first + i] = s / B[first + i, HALF]


@ti.kernel
def solve_lines(S: Table, G: Table, rows: Rows, count: ti.i32, B: Table, spread: Flat):
    """SOL = line solutions of RES in the first `count` grid rows; `spread` gets the part that K^-1 must distribute."""
    for r in range(count):
        l, j = rows[r, 0], rows[r, 1]
        n2 = int(G[l, NX]) + 1
        first = int(G[l, OFF]) + j * n2
        target = int(G[l, SPREAD]) + j * int(G[l, PERIOD])
        substitute(S, B, first, n2)
        for i in range(n2):
            spread[target + i] = S[SOL, first + i] if S[KIND, first + i] == 2.0 else 0.0


@ti.kernel
def collect_lines(S: Table, G: Table, rows: Rows, count: ti.i32, spread: Flat):
    """COR = correction of each level: K^-1 of the distributed part, the line solution elsewhere, RES where dry."""
    for r in range(count):
        l, j = rows[r, 0], rows[r, 1]
        n2 = int(G[l, NX]) + 1
        source = int(G[l, SPREAD]) + j * int(G[l, PERIOD])
        for i in range(n2):
            k = int(G[l, OFF]) + j * n2 + i
            z = S[SOL, k] if S[KIND, k] == 1.0 else S[RES, k]
            S[COR, k] = spread[source + i] if S[KIND, k] == 2.0 else z
