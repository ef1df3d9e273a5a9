"""The discrete Reynolds equation, its linearisation and its Jacobian product.

Conservative five-point Poiseuille part; Couette part third-order upwind-biased, q_{i+1/2} = (2 q_{i+1} + 5 q_i - q_{i-1})/6;
time derivative of the newest level, in a frame that may move with the oil. Everything is multiplied by dx.
"""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import (
    Blocks,
    Flat,
    L,
    LinearFlat,
    Table,
    V,
    W,
    above,
    below,
    cells,
    face_weights,
    lanes_in,
    lanes_out,
)
from tehl_taichi.pressure.fields import (
    AD,
    AU,
    BD,
    BU,
    CT,
    DX,
    DY,
    EPS,
    FILM,
    FLOOR,
    FRAME,
    K0,
    K1,
    MASK,
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
    R,
)
from tehl_taichi.pressure.fluxes import Face, driven_x, face_above, face_below, face_x, net_driven_y, wall_x, wall_y
from tehl_taichi.pressure.upwind import couette_weights


@ti.func
def carried(S: ti.template(), row: ti.template(), density: ti.template(), k, frame):
    """Mass flow (`row`) of node k in a frame that moves with `frame` u_m and takes `density` along."""
    out = S[row, k] - frame * S[density, k]
    if ti.static(row == density):
        out = (1.0 - frame) * S[row, k]
    return out


@ti.func
def transport(S: ti.template(), k, i, couette: ti.template(), frame):
    """dx d(rho H)/dX at node k; couette: row of the density."""
    w, out = couette_weights(i), V(0.0)
    for t in ti.static(range(4)):
        out += w[t] * carried(S, couette, RHO, k + t - 2, frame) * S[H, k + t - 2]
    return out


@ti.kernel
def residual(S: ti.template(), G: Table, couette: ti.template(), skew: ti.template(), rheology: ti.template(),
             alone: ti.template()):
    """Compute R = dx [ d(rho H)/dX + d(rho H)/dT - div(eps grad P) ] at the unknowns of the finest level, 0 elsewhere.

    With d/dT in a moving frame, d/dX contains only the rest of the Couette flow.
    """
    nx, ny, off = cells(G, 0)
    n2 = nx + 1
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        up, down = face_weights(s, ny)
        inv, metric, CT_0, frame = 1 / G[0, DX], G[0, DX] / G[0, DY] ** 2, G[0, CT], G[0, FRAME]
        first, along, across = off + s * n2, wall_x(G, 0), wall_y(G, 0)
        S[R, first], S[R, first + nx], left = V(0.0), V(0.0), V(0.0)
        for i in range(nx):
            k = first + i
            right = driven_x(S, k, skew, rheology, along)
            if i > 0:
                r = transport(S, k, i, couette, frame) + CT_0 * S[RHO, k] * S[H, k] + S[QOLD, k] - (right - left) * inv
                if ny > 0:
                    r -= net_driven_y(S, k, n2, up, down, skew, rheology, across) * metric
                S[R, k] = ti.select(S[MASK, k] > 0.0, r, V(0.0))  # not 0 times what ghosts have, which need not be a number
            left = right


@ti.func
def stencil(S: ti.template(), k, row: ti.template(), density: ti.template(), frame):
    """`carried` at the nodes i-2 ... i+1."""
    return (carried(S, row, density, k - 2, frame), carried(S, row, density, k - 1, frame),
            carried(S, row, density, k, frame), carried(S, row, density, k + 1, frame))


@ti.func
def store_rows(J: ti.template(), k, rows: ti.template(), c0, c1, c2, c3):
    for t, c in ti.static(enumerate((c0, c1, c2, c3))):
        J[rows[t], k] = ti.cast(c, J.dtype)


@ti.kernel
def linearise(S: ti.template(), J: ti.template(), G: Table, blocks: Blocks, first: ti.i32, last: ti.i32,
              known: Flat, couette: ti.template(), slope: ti.template(), skew: ti.template(), rheology: ti.template(),
              alone: ti.template()):
    """Compute Jacobian rows, EPS and the diagonal in the blocks first..last-1; needs `laws` and `slopes`.

    known[0]: 1 after another linearisation of the same solve (:mod:`tehl_taichi.pressure.saturation`), else 0; couette: row of
    the density in the Couette flow; slope: row of its derivative; skew: as in :class:`tehl_taichi.pressure.fields.LawRows`.
    """
    ti.loop_config(block_dim=1, serialize=alone)
    for b in range(first, last):
        l, s = blocks[b, 0], blocks[b, 1]
        nx, ny, off = cells(G, l)
        n2 = nx + 1
        up, down = face_weights(s, ny)
        metric, inv, CT_l, K_0, K_1 = G[l, DX] / G[l, DY] ** 2, 1 / G[l, DX], G[l, CT], G[l, K0], G[l, K1]
        frame, along, across = G[l, FRAME], wall_x(G, l), wall_y(G, l)
        left = Face(p0=V(0.0), p1=V(0.0), h0=V(0.0), h1=V(0.0), eps=V(0.0), base=V(0.0))
        for i in range(nx):
            k = off + s * n2 + i
            right = face_x(S, k, known[0], skew, rheology, along)
            if i > 0:
                w = couette_weights(i)
                q, c = stencil(S, k, slope, QP, frame), stencil(S, k, couette, RHO, frame)
                a2 = w[2] * q[2] + CT_l * S[QP, k] + (left.p1 - right.p0) * inv
                b2 = w[2] * c[2] + CT_l * S[RHO, k] + (left.h1 - right.h0) * inv
                total = (left.eps + right.eps) * inv
                if ny > 0:
                    u, d = up * metric, down * metric
                    upper = face_above(S, k, n2, skew, rheology, across)
                    lower = face_below(S, k, n2, skew, rheology, across)
                    a2 += d * lower.p1 - u * upper.p0
                    b2 += d * lower.h1 - u * upper.h0
                    total += u * upper.eps + d * lower.eps
                    store_rows(J, k, ti.static((AU, AD, BU, BD)), -u * upper.p1, d * lower.p0, -u * upper.h1, d * lower.h0)
                store_rows(J, k, ti.static(A), w[0] * q[0], w[1] * q[1] + left.p0 * inv, a2, w[3] * q[3] - right.p1 * inv)
                store_rows(J, k, ti.static(B), w[0] * c[0], w[1] * c[1] + left.h0 * inv, b2, w[3] * c[3] - right.h1 * inv)
                J[EPS, k] = ti.cast(total, J.dtype)
                own = 0.5 * (q[2] + c[2] * K_0) + CT_l * (S[QP, k] + S[RHO, k] * K_0)
                S[D, k] = ti.max(own + (c[3] / 3 - c[1]) * K_1 + total, 0.5 * K_0)
            left = right


@ti.func
def reynolds_row(J: ti.template(), k, n2):
    """Row k of the Jacobian times the changes of pressure (TRIAL) and film (FILM)."""
    out = J[AU, k] * above(J, TRIAL, k, n2) + J[AD, k] * below(J, TRIAL, k, n2)
    out += J[BU, k] * above(J, FILM, k, n2) + J[BD, k] * below(J, FILM, k, n2)
    for t in ti.static(range(4)):
        out += J[A[t], k] * J[TRIAL, k + t - 2] + J[B[t], k] * J[FILM, k + t - 2]
    return out


@ti.kernel
def contact_right(S: ti.template(), J: ti.template(), G: Table, right: LinearFlat, alone: ti.template()):
    """Set `right` of touching nodes to minus the scaled rows times the violation of the film's floor."""
    nx, ny, off = cells(G, 0)
    n2 = nx + 1
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        for k in range(off + s * n2, off + (s + 1) * n2):
            J[TRIAL, k], J[FILM, k] = L(J, 0.0), ti.cast(S[H, k] - G[0, FLOOR], J.dtype)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        for q in range(s * n2, (s + 1) * n2):
            k = off + q
            change = ti.select(S[TOUCH, k] > 0.0, -reynolds_row(J, k, n2) / J[SCALE, k], lanes_in(right, q))
            lanes_out(right, q, change)
