"""Parallel loops over all columns of all blocks. Each kernel does the work of its namesake in the parent folder (or in
:mod:`tehl_taichi.engine.simd`), with the same arguments; `twins` lists the pairs."""

from tehl_taichi.engine.elementary import exp, maximum
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import read
from tehl_taichi.engine.simd import (
    Blocks,
    Flat,
    L,
    LaneBlock,
    LinearFlat,
    Table,
    V,
    W,
    below,
    cells,
    face_weights,
    lanes_in,
    lanes_out,
    repeated,
    row_shares,
)
from tehl_taichi.laws.density import rho_ratio
from tehl_taichi.laws.rheology import DP
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.pressure import active_sets
from tehl_taichi.pressure.balances import parts, sets
from tehl_taichi.pressure.conditions import Conditions
from tehl_taichi.pressure.fields import (
    AD,
    AU,
    BD,
    BU,
    CT,
    DRY,
    DX,
    DY,
    EPS,
    FILM,
    FLOOR,
    FRAME,
    ILAM,
    JN,
    K0,
    K1,
    KIND,
    MASK,
    NX,
    QOLD,
    QP,
    RHO,
    SCALE,
    TOUCH,
    TRIAL,
    A,
    B,
    D,
    H,
    P,
    R,
)
from tehl_taichi.pressure.fluxes import Face, driven, face_above, face_x, node, wall_x, wall_y
from tehl_taichi.pressure.isothermal_laws import store_laws, store_slopes
from tehl_taichi.pressure.linear.line_solver import DRY_KIND, LOCAL
from tehl_taichi.pressure.linear.transfer import Rows
from tehl_taichi.pressure.reynolds import reynolds_row, stencil, store_rows, transport
from tehl_taichi.pressure.storage_term import COUETTE, LOST, START, Frame, differences, eighth
from tehl_taichi.pressure.tractions import Stack, on_bodies, store
from tehl_taichi.pressure.upwind import couette_weights

ALONG, ABOVE = tuple(range(5)), tuple(range(5, 10))  # rows of the table of faces: of the face ahead and of the face above
FACES = 10


@ti.func
def place(q, n2):
    """(block, number along x) of column q."""
    return q // n2, q % n2


@ti.kernel
def put(S: ti.template(), G: Table, l: ti.i32, row: ti.i32, values: Table, alone: ti.template()):
    """Write `values` to a row of the table of level l."""
    nx, ny, off = cells(G, l)
    for q in range((ny // W + 1) * (nx + 1)):
        s, i = place(q, nx + 1)
        S[row, off + q] = ti.Vector([values[ti.min(s * W + u, ny), i] for u in ti.static(range(W))])


@ti.kernel
def get(S: ti.template(), G: Table, l: ti.i32, row: ti.i32, values: Table, alone: ti.template()):
    """Read a row of the table of level l into `values`."""
    nx, ny, off = cells(G, l)
    for q in range((ny // W + 1) * (nx + 1)):
        s, i = place(q, nx + 1)
        v = S[row, off + q]
        for u in ti.static(range(W)):
            if s * W + u <= ny:
                values[i, s * W + u] = v[u]


@ti.kernel
def save(S: ti.template(), G: Table, row: ti.i32, out: Flat, alone: ti.template()):
    """Copy a row of the finest level to `out`."""
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        lanes_out(out, q, S[row, off + q])


@ti.kernel
def advance(S: ti.template(), G: Table, old: Flat, step: LinearFlat, t: Flat, alone: ti.template()):
    """Set P to the old pressure plus t[0] times the step, not below 0, where the pressure is unknown."""
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        p = lanes_in(old, q)
        S[P, off + q] = ti.select(S[MASK, off + q] > 0.0, ti.max(p + t[0] * lanes_in(step, q), 0.0), p)


@ti.kernel
def laws(S: ti.template(), G: Table, oil: ti.template(), conditions: Flat, rows: ti.template(), slopes: ti.template(),
         alone: ti.template()):
    """Set density and viscosity of the finest level, or (slopes) their derivatives by the pressure."""
    nx, ny, off = cells(G, 0)
    for k in range(off, off + (ny // W + 1) * (nx + 1)):
        scene = read(Conditions, conditions)
        p, h = S[P, k] * scene.p_H + slopes * DP, maximum(S[H, k], G[0, FLOOR])
        rho, le = rho_ratio(oil, p, scene.inlet), ln_eta(oil, p, scene.inlet) - scene.ln_eta0
        if ti.static(slopes):
            store_slopes(S, k, rho, le, scene.p_H / DP)
            if ti.static(rows.slope != QP):
                S[rows.slope, k], S[rows.skew + 1, k] = S[QP, k], V(0.0)
        else:
            store_laws(S, k, h, rho, le, exp(-le), G[0, ILAM])
            if ti.static(rows.couette != RHO):
                S[rows.couette, k], S[rows.skew, k] = rho, V(1.0)


@ti.kernel
def residual(T: ti.template(), S: ti.template(), G: Table, couette: ti.template(), skew: ti.template(), rheology: ti.template(),
             alone: ti.template()):
    """Set the residual R; the fluxes of the faces ahead and above come first, in the table T."""
    nx, ny, off = cells(G, 0)
    for k in range(off, off + (ny // W + 1) * (nx + 1)):
        here = node(S, k, nx + 1, 0, skew)
        T[ALONG[0], k] = driven(here, node(S, k + 1, nx + 1, 0, skew), rheology, wall_x(G, 0), True)
        if ny > 0:
            T[ABOVE[0], k] = driven(here, node(S, k, nx + 1, 1, skew), rheology, wall_y(G, 0), False)
    for q in range((ny // W + 1) * (nx + 1)):
        k, n2 = off + q, nx + 1
        s, i = place(q, n2)
        r = V(0.0)
        if 0 < i < nx:
            net, metric = T[ALONG[0], k] - T[ALONG[0], k - 1], G[0, DX] / G[0, DY] ** 2
            r = transport(S, k, i, couette, G[0, FRAME]) + G[0, CT] * S[RHO, k] * S[H, k] + S[QOLD, k] - net / G[0, DX]
            if ny > 0:
                up, down = face_weights(s, ny)
                r -= (up * T[ABOVE[0], k] - weighted(down, below(T, ABOVE[0], k, n2))) * metric
        S[R, k] = ti.select(S[MASK, k] > 0.0, r, V(0.0))


@ti.func
def weighted(weight, value):
    """weight * value, and 0 for weight 0: values beyond the first row may be nan."""
    return ti.select(weight > 0.0, weight * value, V(0.0))


@ti.func
def keep_face(T: ti.template(), rows: ti.template(), k, face):
    """Store a face in the table of faces."""
    T[rows[0], k], T[rows[1], k], T[rows[2], k] = face.p0, face.p1, face.h0
    T[rows[3], k], T[rows[4], k] = face.h1, face.eps


@ti.kernel
def linearise(T: ti.template(), S: ti.template(), J: ti.template(), G: Table, blocks: Blocks, first: ti.i32, last: ti.i32,
              known: Flat, couette: ti.template(), slope: ti.template(), skew: ti.template(), rheology: ti.template(),
              alone: ti.template()):
    """Set the Jacobian rows; the faces ahead and above come first, in the table T."""
    for n in range((last - first) * (int(G[0, NX]) + 1)):
        b, i = first + n // (int(G[0, NX]) + 1), n % (int(G[0, NX]) + 1)
        l = blocks[b, 0]
        nx, ny, off = cells(G, l)
        k = off + blocks[b, 1] * (nx + 1) + i
        if i < nx:
            keep_face(T, ALONG, k, face_x(S, k, known[0], skew, rheology, wall_x(G, l)))
            if ny > 0:
                keep_face(T, ABOVE, k, face_above(S, k, nx + 1, skew, rheology, wall_y(G, l)))
    for n in range((last - first) * (int(G[0, NX]) + 1)):
        b, i = first + n // (int(G[0, NX]) + 1), n % (int(G[0, NX]) + 1)
        l, s = blocks[b, 0], blocks[b, 1]
        nx, ny, off = cells(G, l)
        if 0 < i < nx:
            node_rows(T, S, J, G, l, s, i, off + s * (nx + 1) + i, nx + 1, ny, couette, slope)


@ti.func
def face_of(T: ti.template(), rows: ti.template(), k):
    """Face of column k from the table of faces."""
    return Face(p0=T[rows[0], k], p1=T[rows[1], k], h0=T[rows[2], k], h1=T[rows[3], k], eps=T[rows[4], k], base=V(0.0))


@ti.func
def face_beneath(T: ti.template(), rows: ti.template(), k, n2):
    """Face above the row below column k, from the table of faces."""
    return Face(p0=below(T, rows[0], k, n2), p1=below(T, rows[1], k, n2), h0=below(T, rows[2], k, n2),
                h1=below(T, rows[3], k, n2), eps=below(T, rows[4], k, n2), base=V(0.0))


@ti.func
def node_rows(T: ti.template(), S: ti.template(), J: ti.template(), G: ti.template(), l, s, i, k, n2, ny,
              couette: ti.template(), slope: ti.template()):
    """Set the Jacobian rows, EPS and the diagonal of one column."""
    inv, CT_l, frame = 1 / G[l, DX], G[l, CT], G[l, FRAME]
    left, right, w = face_of(T, ALONG, k - 1), face_of(T, ALONG, k), couette_weights(i)
    q, c = stencil(S, k, slope, QP, frame), stencil(S, k, couette, RHO, frame)
    a2 = w[2] * q[2] + CT_l * S[QP, k] + (left.p1 - right.p0) * inv
    b2 = w[2] * c[2] + CT_l * S[RHO, k] + (left.h1 - right.h0) * inv
    total = (left.eps + right.eps) * inv
    if ny > 0:
        up, down = face_weights(s, ny)
        u, d = up * (G[l, DX] / G[l, DY] ** 2), down * (G[l, DX] / G[l, DY] ** 2)
        upper, lower = face_of(T, ABOVE, k), face_beneath(T, ABOVE, k, n2)
        a2 += weighted(d, lower.p1) - u * upper.p0
        b2 += weighted(d, lower.h1) - u * upper.h0
        total += u * upper.eps + weighted(d, lower.eps)
        store_rows(J, k, ti.static((AU, AD, BU, BD)), -u * upper.p1, weighted(d, lower.p0), -u * upper.h1,
                   weighted(d, lower.h0))
    store_rows(J, k, ti.static(A), w[0] * q[0], w[1] * q[1] + left.p0 * inv, a2, w[3] * q[3] - right.p1 * inv)
    store_rows(J, k, ti.static(B), w[0] * c[0], w[1] * c[1] + left.h0 * inv, b2, w[3] * c[3] - right.h1 * inv)
    J[EPS, k] = ti.cast(total, J.dtype)
    own = 0.5 * (q[2] + c[2] * G[l, K0]) + CT_l * (S[QP, k] + S[RHO, k] * G[l, K0])
    S[D, k] = ti.max(own + (c[3] / 3 - c[1]) * G[l, K1] + total, 0.5 * G[l, K0])


@ti.kernel
def contact_right(S: ti.template(), J: ti.template(), G: Table, right: LinearFlat, alone: ti.template()):
    """Set the right-hand side of touching nodes: the change of film that takes the gap to its floor."""
    nx, ny, off = cells(G, 0)
    for k in range(off, off + (ny // W + 1) * (nx + 1)):
        J[TRIAL, k], J[FILM, k] = L(J, 0.0), ti.cast(S[H, k] - G[0, FLOOR], J.dtype)
    for q in range((ny // W + 1) * (nx + 1)):
        k = off + q
        lanes_out(right, q, ti.select(S[TOUCH, k] > 0.0, -reynolds_row(J, k, nx + 1) / J[SCALE, k], lanes_in(right, q)))


@ti.kernel
def inject(S: ti.template(), J: ti.template(), G: Table, levels: ti.i32, shared: ti.i32, rows: Rows, alone: ti.template()):
    """Copy the fields `rows` to all coarser levels from the coinciding nodes of the finest level, all levels in parallel."""
    for n in range((levels - 1) * shared * (int(G[0, NX]) // 2 + 1)):
        size = shared * (int(G[0, NX]) // 2 + 1)
        l, q = 1 + n // size, n % size
        mx, my, off = cells(G, l)
        if q < (my // W + 1) * (mx + 1):
            inject_column(S, J, G, l, q // (mx + 1), q % (mx + 1), off + q, my, rows)


@ti.func
def inject_column(S: ti.template(), J: ti.template(), G: ti.template(), l, t, i, c, my, rows: ti.template()):
    """Copy the fields `rows` of column i of block t of level l (column c of the table); ghosts stay dry."""
    nx, ny, off = cells(G, 0)
    for n in range(rows.shape[0]):
        S[rows[n], c] = from_finest(S, rows[n], off, nx + 1, ny // W, l, t, i)
    for u in ti.static(range(W)):
        if t * W + u >= int(G[l, JN]):
            S[DRY, c][u], S[TOUCH, c][u] = 1.0, 0.0
            if t * W + u > my:
                S[P, c][u], S[H, c][u] = 0.0, 1.0
    J[KIND, c] = ti.select(S[DRY, c] > 0.0, L(J, DRY_KIND), L(J, LOCAL))


@ti.func
def from_finest(S: ti.template(), row, off, n2, last, l, t, i):
    """Lanes of block t in column i of level l: rows of the finest level, 2^l apart; ghosts from the last block."""
    out = V(0.0)
    for u in ti.static(range(W)):
        if l == 1:
            out[u] = S[row, off + ti.min(2 * t + ti.static(2 * u // W), last) * n2 + 2 * i][ti.static(2 * u % W)]
        else:
            out[u] = S[row, off + ti.min(((t * W + u) << l) // W, last) * n2 + (i << l)][0]
    return out


@ti.kernel
def replace_rows(S: ti.template(), J: ti.template(), G: Table, blocks: Blocks, touching: ti.i32, alone: ti.template()):
    """Replace the Jacobian rows of touching (if any) and dry nodes."""
    for q in range(blocks.shape[0] * (int(G[0, NX]) + 1)):
        b, i = q // (int(G[0, NX]) + 1), q % (int(G[0, NX]) + 1)
        nx, _, off = cells(G, blocks[b, 0])
        if i <= nx:
            k = off + blocks[b, 1] * (nx + 1) + i
            if touching == 1:
                active_sets.contact_rows(S, J, G, blocks[b, 0], k, i)
            active_sets.dry_rows(S, J, k)


@ti.kernel
def choose_sets(S: ti.template(), J: ti.template(), G: Table, cap: ti.f64, b: LinearFlat, mass_row: LinearFlat,
                touching: Table, alone: ti.template()):
    """Choose touching and dry nodes; set row scales, right-hand side and weights of the outflow.

    touching[0, 0]: 1 if a node touches, else 0.
    """
    for _ in range(1):
        touching[0, 0] = 0.0
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        k, s = off + q, q // (nx + 1)
        p, r, gap = parts(S, k, G[0, FLOOR], 1 / G[0, K0])
        share, inside = row_shares(s, ny), S[MASK, k]
        touch, dry = sets(p, r, gap, inside)
        scale = ti.select(dry > 0.0, V(1.0), ti.min(S[D, k], cap))
        S[TOUCH, k], S[DRY, k], J[SCALE, k] = touch, dry, ti.cast(scale, J.dtype)
        lanes_out(b, q, ti.select(dry > 0.0, -p * inside, -S[R, k] / scale * inside))
        lanes_out(mass_row, q, share * scale * (1.0 - dry) * (1.0 - touch))
        if touch.sum() > 0.0:
            touching[0, 0] = 1.0


@ti.kernel
def follow(S: ti.template(), O: ti.template(), G: Table, numbers: Flat, states: Table, ways: Table, alone: ti.template()):
    """Set QOLD, the part of the storage term by earlier states along the paths of the oil."""
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        frame, i = read(Frame, numbers), q % (nx + 1)
        out, lost = differences(O, q - i, i, nx, states, ways, int(frame.states))
        S[QOLD, off + q] = frame.speed * O[COUETTE, q] - frame.rate * (O[START, q] + out)
        O[LOST, q] = lost
    for q in range((ny // W + 1) * (nx + 1)):
        frame, i = read(Frame, numbers), q % (nx + 1)
        if frame.damped > 0.0 and 4 <= i < nx - 3:
            S[QOLD, off + q] = S[QOLD, off + q] + frame.rate * eighth(O, q)


@ti.kernel
def keep(S: ti.template(), O: ti.template(), G: Table, row: Flat, alone: ti.template()):
    """Keep rho H of the newest state in row[0] of the history O."""
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        O[int(row[0]), q] = repeated(S[RHO, off + q] * S[H, off + q], q // (nx + 1), ny)


@ti.func
def lane_block(G: ti.template(), q):
    """The LaneBlock of column q of the finest level; it belongs to no tile."""
    nx, ny, off = cells(G, 0)
    return LaneBlock(k=off + q, q=q, c=0, i=q % (nx + 1), s=q // (nx + 1), nx=nx, ny=ny)


@ti.kernel
def tractions(S: ti.template(), G: Table, rheology: ti.template(), conditions: Flat, out: Stack):
    """Compute the tractions on both bodies into `out`."""
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        at = lane_block(G, q)
        store(out, at, *on_bodies(S, G, at, rheology, read(Conditions, conditions)))
