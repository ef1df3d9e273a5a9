"""The discrete Reynolds equation, its linearisation and its Jacobian product.

Conservative five-point Poiseuille part, face mobility = log-mean of 1/eta times arithmetic mean of rho H^3; Couette part
third-order upwind-biased, q_{i+1/2} = (2 q_{i+1} + 5 q_i - q_{i-1})/6; BDF2 in time. Everything is multiplied by dx.
"""

import taichi as ti

from tehl_taichi.kernels.fields import (
    CT,
    CX,
    CY,
    DLE,
    DRHO,
    DRY,
    DX,
    DY,
    EX,
    EY,
    FLOOR,
    IE,
    JN,
    K0,
    K1,
    LE,
    MOB,
    NX,
    NY,
    OFF,
    QOLD,
    QP,
    RHO,
    TOUCH,
    D,
    H,
    P,
    R,
)
from tehl_taichi.physics.density import rho_ratio
from tehl_taichi.physics.viscosity import ln_eta

Table = ti.types.ndarray(dtype=ti.f64, ndim=2)
Flat = ti.types.ndarray(dtype=ti.f64, ndim=1)
Rows = ti.types.ndarray(dtype=ti.i32, ndim=2)  # (level, j) of every grid row, finest level first

# weights of q_{i-2}, q_{i-1}, q_i, q_{i+1} in dx dq/dX
C_M2, C_M1, C_0, C_P1 = 1 / 6, -1.0, 0.5, 1 / 3
DP = 1e3  # Pa, step of the difference quotients of the laws: their scale is 1e8 Pa, so the quotient is good to 1e-5


@ti.func
def cells(G: ti.template(), l):
    return int(G[l, NX]), int(G[l, NY]), int(G[l, OFF])


@ti.func
def couette_weight(i, t):
    """Weight of q_{i+t} in dx dq/dX; the first interior node falls back to the central difference."""
    w = 0.0
    if i == 1:
        w = 0.5 * t * (t * t == 1)
    else:
        if t == -2:
            w = C_M2
        elif t == -1:
            w = C_M1
        elif t == 0:
            w = C_0
        else:
            w = C_P1
    return w


@ti.func
def log_mean(l0, l1, e0):
    """Logarithmic mean of 1/eta between two nodes, l = ln eta, e0 = exp(-l0)."""
    d = l1 - l0
    out = e0 * (1 - d / 2 + d * d / 6)
    if abs(d) > 1e-3:
        out = e0 * (1 - ti.exp(-d)) / d
    return out


@ti.func
def node_laws(S: ti.template(), k, oil: ti.template(), p_H, Gamma, ln_eta0, inv_lambda, floor):
    p = S[P, k] * p_H
    rho = rho_ratio(oil, p, Gamma)
    le = ln_eta(oil, p, Gamma) - ln_eta0
    h = ti.max(S[H, k], floor)
    S[RHO, k] = rho
    S[LE, k] = le
    S[IE, k] = ti.exp(-le)
    S[MOB, k] = rho * h * h * h * inv_lambda


@ti.kernel
def laws(S: Table, G: Table, rows: Rows, first: ti.i32, last: ti.i32, oil: ti.template(), p_H: ti.f64, Gamma: ti.f64,
         ln_eta0: ti.f64, inv_lambda: ti.f64, slopes: ti.i32):
    """Density, viscosity and mobility in the grid rows first..last-1; with `slopes` also their derivatives in P."""
    for r in range(first, last):
        l, j = rows[r, 0], rows[r, 1]
        nx, ny, off = cells(G, l)
        for i in range(nx + 1):
            k = off + j * (nx + 1) + i
            node_laws(S, k, oil, p_H, Gamma, ln_eta0, inv_lambda, G[l, FLOOR])
            if slopes == 1:
                p = S[P, k] * p_H + DP
                S[DRHO, k] = (rho_ratio(oil, p, Gamma) - S[RHO, k]) * (p_H / DP)
                S[DLE, k] = (ln_eta(oil, p, Gamma) - ln_eta0 - S[LE, k]) * (p_H / DP)
                S[QP, k] = S[DRHO, k] * S[H, k]


@ti.func
def mobility(S: ti.template(), k0, k1):
    return 0.5 * (S[MOB, k0] + S[MOB, k1]) * log_mean(S[LE, k0], S[LE, k1], S[IE, k0])


@ti.func
def flux_x(S: ti.template(), k):
    return S[EX, k] * (S[P, k + 1] - S[P, k])


@ti.func
def flux_y(S: ti.template(), k, n2):
    return S[EY, k] * (S[P, k + n2] - S[P, k])


@ti.func
def face_mobilities(S: ti.template(), G: ti.template(), l, j):
    nx, ny, off = cells(G, l)
    n2 = nx + 1
    for i in range(nx):
        k = off + j * n2 + i
        S[EX, k] = mobility(S, k, k + 1) / G[l, DX]
    if j < ny:
        for i in range(1, nx):
            k = off + j * n2 + i
            S[EY, k] = mobility(S, k, k + n2) * G[l, DX] / G[l, DY] ** 2


@ti.func
def transport(S: ti.template(), k, i):
    """dx d(rho H)/dX at node k."""
    out = 0.0
    for t in ti.static(range(-2, 2)):
        if i + t >= 0:
            out += couette_weight(i, t) * S[RHO, k + t] * S[H, k + t]
    return out


@ti.func
def poiseuille_y(S: ti.template(), k, j, ny, n2):
    """Net y flux out of the cell; mirrored at j = 0, no flux beyond the last row."""
    out = 0.0
    if j < ny:
        out += flux_y(S, k, n2) * (2.0 if j == 0 else 1.0)
    if j > 0:
        out -= flux_y(S, k - n2, n2)
    return out


@ti.kernel
def residual(S: Table, G: Table, l: ti.i32):
    """R = dx [ d(rho H)/dX + d(rho H)/dT - div(eps grad P) ] on the unknown rows, 0 elsewhere."""
    nx, ny, off = cells(G, l)
    n2 = nx + 1
    jn = int(G[l, JN])
    for j in range(ny + 1):
        face_mobilities(S, G, l, j)
    for j in range(ny + 1):
        for i in range(n2):
            k = off + j * n2 + i
            r = 0.0
            if j < jn and i > 0 and i < nx:
                r = transport(S, k, i) + G[l, CT] * S[RHO, k] * S[H, k] + S[QOLD, k]
                r -= flux_x(S, k) - flux_x(S, k - 1) + poiseuille_y(S, k, j, ny, n2)
            S[R, k] = r


@ti.func
def linear_face(S: ti.template(), k0, k1, scale, floor):
    """Linearised flux eps (P1 - P0) scale: its derivatives in P0, P1, H0, H1, and the frozen mobility."""
    l0, l1, e0, e1 = S[LE, k0], S[LE, k1], S[IE, k0], S[IE, k1]
    d = l1 - l0
    mean = log_mean(l0, l1, e0)
    mean_0, mean_1 = 0.5 * e0, 0.5 * e1
    if abs(d) > 1e-3:
        mean_0, mean_1 = (e0 - mean) / d, (mean - e1) / d
    m = 0.5 * (S[MOB, k0] + S[MOB, k1])
    g = (S[P, k1] - S[P, k0]) * scale
    eps = m * mean * scale
    d0 = 0.5 * S[MOB, k0] * S[DRHO, k0] / S[RHO, k0] * mean - m * mean_0 * S[DLE, k0]
    d1 = 0.5 * S[MOB, k1] * S[DRHO, k1] / S[RHO, k1] * mean - m * mean_1 * S[DLE, k1]
    h0, h1 = 0.0, 0.0
    if S[H, k0] > floor:
        h0 = 1.5 * S[MOB, k0] / S[H, k0] * mean
    if S[H, k1] > floor:
        h1 = 1.5 * S[MOB, k1] / S[H, k1] * mean
    return ti.Vector([g * d0 - eps, g * d1 + eps, g * h0, g * h1, eps])


@ti.func
def store_face(S: ti.template(), rows: ti.template(), eps_row: ti.template(), k, c):
    for n in ti.static(range(4)):
        S[rows[n], k] = c[n]
    S[eps_row, k] = c[4]


@ti.func
def diagonal(S: ti.template(), G: ti.template(), l, k, i, j):
    nx, ny, off = cells(G, l)
    n2 = nx + 1
    own = S[QP, k] + S[RHO, k] * G[l, K0]
    d = (C_0 + G[l, CT]) * own + (C_M1 * S[RHO, k - 1] + C_P1 * S[RHO, k + 1]) * G[l, K1] + S[EX, k] + S[EX, k - 1]
    if j < ny:
        d += S[EY, k] * (2.0 if j == 0 else 1.0)
    if j > 0:
        d += S[EY, k - n2]
    return ti.max(d, 0.5 * G[l, K0])


@ti.kernel
def linearise(S: Table, G: Table, rows: Rows, first: ti.i32, last: ti.i32):
    """Face derivatives and the diagonal in the grid rows first..last-1; needs `laws` with slopes."""
    for r in range(first, last):
        l, j = rows[r, 0], rows[r, 1]
        nx, ny, off = cells(G, l)
        n2 = nx + 1
        for i in range(nx):
            k = off + j * n2 + i
            store_face(S, ti.static(CX), EX, k, linear_face(S, k, k + 1, 1 / G[l, DX], G[l, FLOOR]))
        if j < ny:
            for i in range(1, nx):
                k = off + j * n2 + i
                store_face(S, ti.static(CY), EY, k, linear_face(S, k, k + n2, G[l, DX] / G[l, DY] ** 2, G[l, FLOOR]))
    for r in range(first, last):
        l, j = rows[r, 0], rows[r, 1]
        nx, ny, off = cells(G, l)
        for i in range(nx + 1):
            k = off + j * (nx + 1) + i
            S[D, k] = 1.0
            if j < int(G[l, JN]) and i > 0 and i < nx:
                S[D, k] = diagonal(S, G, l, k, i, j)


@ti.func
def linear_flux(S: ti.template(), rows: ti.template(), k, kr, v0, v1, w0, w1):
    return S[rows[0], k] * v0 + S[rows[1], k] * v1 + S[rows[2], k] * w0 + S[rows[3], k] * w1


@ti.func
def reynolds_row(S: ti.template(), G: ti.template(), l, V: ti.template(), W: ti.template(), n, i, j):
    """Row (i, j) of the Jacobian times (V[n], W[n]): pressure change V, film change W, both tables over the level."""
    nx, ny, off = cells(G, l)
    n2 = nx + 1
    q = j * n2 + i
    k = off + q
    out = G[l, CT] * (S[QP, k] * V[n, q] + S[RHO, k] * W[n, q])
    for t in ti.static(range(-2, 2)):
        if i + t >= 0:
            out += couette_weight(i, t) * (S[QP, k + t] * V[n, q + t] + S[RHO, k + t] * W[n, q + t])
    out -= linear_flux(S, ti.static(CX), k, k + 1, V[n, q], V[n, q + 1], W[n, q], W[n, q + 1])
    out += linear_flux(S, ti.static(CX), k - 1, k, V[n, q - 1], V[n, q], W[n, q - 1], W[n, q])
    if j < ny:
        f = linear_flux(S, ti.static(CY), k, k + n2, V[n, q], V[n, q + n2], W[n, q], W[n, q + n2])
        out -= f * (2.0 if j == 0 else 1.0)
    if j > 0:
        out += linear_flux(S, ti.static(CY), k - n2, k, V[n, q - n2], V[n, q], W[n, q - n2], W[n, q])
    return out


@ti.func
def contact_row(S: ti.template(), G: ti.template(), l, W: ti.template(), n, i, j):
    """Row of the contact condition: the transport operator on rho W of the touching nodes (equivalent to W = 0 there)."""
    nx, ny, off = cells(G, l)
    q = j * (nx + 1) + i
    k = off + q
    out = G[l, CT] * S[RHO, k] * W[n, q]
    for t in ti.static(range(-2, 2)):
        if i + t >= 0:
            if S[TOUCH, k + t] == 1.0:
                out += couette_weight(i, t) * S[RHO, k + t] * W[n, q + t]
    return out


@ti.kernel
def jacobian(S: Table, G: Table, l: ti.i32, V: Table, W: Table, out: Table, count: ti.i32):
    """out[n] = J (V[n], W[n]) for n < count, unscaled; identity on dry nodes."""
    nx, ny, off = cells(G, l)
    n2 = nx + 1
    jn = int(G[l, JN])
    for nj in range(count * (ny + 1)):
        n = nj // (ny + 1)
        j = nj % (ny + 1)
        for i in range(n2):
            q = j * n2 + i
            r = V[n, q]
            if j < jn and i > 0 and i < nx:
                if S[DRY, off + q] == 0.0:
                    if S[TOUCH, off + q] == 1.0:
                        r = contact_row(S, G, l, W, n, i, j)
                    else:
                        r = reynolds_row(S, G, l, V, W, n, i, j)
            out[n, q] = r
