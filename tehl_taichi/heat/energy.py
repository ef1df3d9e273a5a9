"""The energy equation in the columns of a film (see :mod:`tehl_taichi.heat.film`), model.md section 6.

In time along the paths of the oil (BDF2); through the film implicit, conduction, both heat sources, both walls (T_s = A + B q
of the bodies) and the flow through the moving nodes in one Newton system per column.
"""

import taichi as ti

from tehl_taichi.engine.elementary import log
from tehl_taichi.engine.lanes import Flat, Table, V, W, cells, tile, tiles
from tehl_taichi.heat.film import Coefficients, couette, node_laws
from tehl_taichi.heat.slots import AA, AB, KINDS, LAST, MS, MSN, MSNN, MX, MY, NIE, NRHO, PS, QA, QB, TS, VY, T, U, slots_around
from tehl_taichi.heat.step import (
    A_HERTZ,
    B_A,
    B_B,
    CENTRE,
    FAR,
    H_HERTZ,
    INLET,
    INV_X,
    INV_Y,
    ITERATIONS,
    LN_ETA0,
    NEAR,
    P_HERTZ,
    RATE,
    SLIP,
    TOLERANCE,
)
from tehl_taichi.physics.boundary import boundary_stress
from tehl_taichi.physics.conduction import conductivity, heat_capacity
from tehl_taichi.physics.density import expansivity
from tehl_taichi.physics.rheology import sensitivity
from tehl_taichi.physics.viscosity import ln_eta
from tehl_taichi.pressure.fields import DX, DY, FLOOR, TOUCH, H, P
from tehl_taichi.pressure.gradient import limited_gradient

DT = 1e-2  # K, step of the difference quotient in temperature
FADE = 1e-4  # heat sources fade as P/(P + FADE) towards the cavitated outlet: switching them off at P = 0 cycles
QUADRATIC = 0.1  # 1/K: a Newton step of a column that changes T by d is followed by one of about 0.1 d^2 (beta/2 is 0.05)
WARM, HOT = 100.0, 900.0  # the temperature stays above the inlet's minus WARM, and below HOT (deg C)
LONGEST = 60.0  # K, of a Newton step of a column
BETA, THROUGH = VY, U  # the velocities' slots, used again once the departure points are known


@ti.func
def outflow(Z: ti.template(), q, i, nx, s, ny, nz, n, step: ti.template()):
    """rho w minus what the moving nodes take along: -(d/dt, d/dx, d/dy) of the mass (flux) below node n."""
    left, right = ti.min(i, 1), ti.min(nx - i, 1)
    out = (Z[q, MS * nz + n] - step[0, NEAR] * Z[q, MSN * nz + n] - step[0, FAR] * Z[q, MSNN * nz + n]) * step[0, RATE]
    out += (Z[q + right, MX * nz + n] - Z[q - left, MX * nz + n]) * (step[0, INV_X] / (left + right))
    if ny > 0:
        lower, upper = slots_around(Z, q, MY * nz + n, nx + 1, s, ny)
        for u in ti.static(range(W)):
            j = s * W + u
            if j == 0:
                out[u] += upper[u] * step[0, INV_Y]  # odd about the plane of symmetry
            elif j < ny:
                out[u] += 0.5 * (upper[u] - lower[u]) * step[0, INV_Y]
    return -out


@ti.func
def prepare(Z: ti.template(), q, s, i, nx, ny, nz, oil: ti.template(), p, ln_eta0, step: ti.template()):
    """What the Newton steps of a column share: the flow through its nodes and -d ln eta/d Gamma; keeps the last iterate."""
    total = outflow(Z, q, i, nx, s, ny, nz, nz - 1, step)
    for n in range(nz):
        t = Z[q, T * nz + n]
        share = Z[q, MS * nz + n] / Z[q, MS * nz + nz - 1]
        Z[q, BETA * nz + n] = (ln_eta0 - log(Z[q, NIE * nz + n]) - ln_eta(oil, p, t + DT)) / DT
        Z[q, THROUGH * nz + n] = outflow(Z, q, i, nx, s, ny, nz, n, step) - share * total
        Z[q, LAST * nz + n] = t


@ti.func
def wall_slopes(Z: ti.template(), q, nz, D1: ti.template()):
    """dT/dzeta at both walls."""
    at_a, at_b = V(0.0), V(0.0)
    for m in range(nz):
        at_a += D1[0, m] * Z[q, T * nz + m]
        at_b += D1[nz - 1, m] * Z[q, T * nz + m]
    return at_a, at_b


@ti.func
def assemble(S: ti.template(), Z: ti.template(), X: ti.template(), k, q, c, nz, w: ti.template(), zeta: ti.template(),
             D1: ti.template(), D2: ti.template(), oil: ti.template(), rheology: ti.template(), p, h, px, py, eta0, slip, rate,
             fade, mu_stress):
    """Newton equations of the inner nodes: X[c, n nz + m] the matrix, X[c, nz nz + n] minus the residual."""
    conduction = conductivity(oil, p) / (h * h)
    e0, centre, newtonian, b = couette(Z, q, nz, w, zeta, rheology, p, h, slip, eta0)
    tau = b * newtonian
    bend = b * sensitivity(rheology, newtonian, p, b)  # d tau/d newtonian
    solid = S[TOUCH, k] > 0.0  # there boundary friction heats instead of the film
    rank_one = nz * (nz + 1)
    for m in range(nz):
        X[c, rank_one + m] = w[m] * Z[q, NIE * nz + m] * Z[q, BETA * nz + m]
    for n in range(1, nz - 1):
        t, ie = Z[q, T * nz + n], Z[q, NIE * nz + n] / eta0
        rc, lever = heat_capacity(oil, p, t), (zeta[n] - centre) * h
        swept = rc / Z[q, NRHO * nz + n] * Z[q, THROUGH * nz + n] / h  # fluxes and rho are both over rho_0
        tx, ty = tau + lever * px, lever * py
        viscous = ti.select(solid, V(0.0), (tx * tx + ty * ty) * ie / b * fade)
        heat = ti.select(solid, mu_stress * ti.abs(slip) / h, viscous)
        squeeze = ti.select(solid, V(0.0), expansivity(oil, p, t) * Z[q, PS * nz + n] * rate * fade)
        gain = ti.select(solid, V(0.0), ie * (bend * newtonian + tau) * newtonian / e0 * fade)
        balance = rc * rate * (t - Z[q, TS * nz + n]) - heat - squeeze * (t + 273.15)
        for m in range(nz):
            link = swept * D1[n, m] - conduction * D2[n, m]
            balance += link * Z[q, T * nz + m]
            X[c, n * nz + m] = link + gain * X[c, rank_one + m]
        X[c, n * nz + n] = X[c, n * nz + n] + rc * rate - squeeze - viscous * Z[q, BETA * nz + n]
        X[c, nz * nz + n] = -balance


@ti.func
def assemble_walls(Z: ti.template(), X: ti.template(), q, c, nz, D1: ti.template(), transfer, B_a, B_b):
    """Equations of both walls, T_s = A + B q; transfer: conductivity over film thickness."""
    base, last = KINDS * nz, nz - 1
    flux_a, flux_b = wall_slopes(Z, q, nz, D1)
    for m in range(nz):
        X[c, m] = -B_a * transfer * D1[0, m]
        X[c, last * nz + m] = B_b * transfer * D1[last, m]
    X[c, 0] = X[c, 0] + 1.0
    X[c, last * nz + last] = X[c, last * nz + last] + 1.0
    X[c, nz * nz] = Z[q, base + AA] + B_a * transfer * flux_a - Z[q, T * nz]
    X[c, nz * nz + last] = Z[q, base + AB] - B_b * transfer * flux_b - Z[q, T * nz + last]


@ti.func
def eliminate(X: ti.template(), c, nz):
    """Solve the system in X[c] in place (conduction makes it safe without pivoting); the solution takes the right side, the
    inverse pivots the diagonal. (x -= y on a field would be atomic.)"""
    rhs = nz * nz
    for d in range(nz):
        inverse = 1.0 / X[c, d * nz + d]
        X[c, d * nz + d] = inverse
        for r in range(d + 1, nz):
            f = X[c, r * nz + d] * inverse
            for m in range(d + 1, nz):
                X[c, r * nz + m] = X[c, r * nz + m] - f * X[c, d * nz + m]
            X[c, rhs + r] = X[c, rhs + r] - f * X[c, rhs + d]
    for back in range(nz):
        d = nz - 1 - back
        total = X[c, rhs + d]
        for m in range(d + 1, nz):
            total -= X[c, d * nz + m] * X[c, rhs + m]
        X[c, rhs + d] = total * X[c, d * nz + d]


@ti.func
def update(Z: ti.template(), X: ti.template(), q, c, s, ny, nz, coldest):
    """Add the Newton step to the temperatures. Returns its largest change (K) and how many nodes were held in range."""
    moved, held = V(0.0), V(0.0)
    for n in range(nz):
        change = ti.min(ti.max(X[c, nz * nz + n], -LONGEST), LONGEST)
        t = Z[q, T * nz + n] + change
        Z[q, T * nz + n] = ti.min(ti.max(t, coldest), HOT)
        moved = ti.max(moved, ti.abs(change))
        held += ti.select(t > HOT, V(1.0), ti.select(t < coldest, V(1.0), V(0.0)))
    return largest_row(moved, s, ny), sum_of_rows(held, s, ny)


@ti.func
def largest_row(values, s, ny):
    out = 0.0
    for u in ti.static(range(W)):
        if s * W + u <= ny:
            out = ti.max(out, values[u])
    return out


@ti.func
def sum_of_rows(values, s, ny):
    out = 0.0
    for u in ti.static(range(W)):
        if s * W + u <= ny:
            out += values[u]
    return out


@ti.func
def change_of_column(Z: ti.template(), q, s, ny, nz):
    """Largest change against the last iterate, K."""
    change = V(0.0)
    for n in range(nz):
        change = ti.max(change, ti.abs(Z[q, T * nz + n] - Z[q, LAST * nz + n]))
    return largest_row(change, s, ny)


@ti.kernel
def energy(S: ti.template(), Z: ti.template(), X: ti.template(), G: Table, w: Flat, zeta: Flat, D1: Coefficients,
           D2: Coefficients, nz: ti.i32, oil: ti.template(), rheology: ti.template(), scale: Coefficients, step: Coefficients,
           out: Table):
    """One implicit step of every column, by Newton, after velocities and departures; out[tile] = (largest change of T against
    the last iterate, columns that did not converge, nodes held in range)."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        p_H, h_scale, a = scale[0, P_HERTZ], scale[0, H_HERTZ], scale[0, A_HERTZ]
        ln_eta0, slip = scale[0, LN_ETA0], scale[0, SLIP]
        floor, dx, dy, eta0 = G[0, FLOOR], G[0, DX], G[0, DY], ti.exp(ln_eta0)
        largest, failed, clamped = 0.0, 0.0, 0.0
        for i in range(first, last):
            q = s * (nx + 1) + i
            k = off + q
            p, h = S[P, k] * p_H, ti.max(S[H, k], floor) * h_scale
            px, py = limited_gradient(S, k, i, nx, s, ny, nx + 1, dx, dy)
            fade = V(1.0)
            if i > scale[0, CENTRE]:
                fade = S[P, k] / (S[P, k] + FADE)
            mu_stress, transfer = boundary_stress(rheology, p), conductivity(oil, p) / h
            prepare(Z, q, s, i, nx, ny, nz, oil, p, ln_eta0, step)
            moved, expected, count = 1e300, 1e300, 0
            while expected > step[0, TOLERANCE] and count < int(step[0, ITERATIONS]):
                if count > 0:
                    node_laws(Z, q, nz, oil, p, ln_eta0)
                count += 1
                assemble(S, Z, X, k, q, c, nz, w, zeta, D1, D2, oil, rheology, p, h, px * (p_H / a), py * (p_H / a), eta0,
                         slip, step[0, RATE], fade, mu_stress)
                assemble_walls(Z, X, q, c, nz, D1, transfer, step[0, B_A], step[0, B_B])
                eliminate(X, c, nz)
                previous = moved
                moved, held = update(Z, X, q, c, s, ny, nz, scale[0, INLET] - WARM)
                clamped += held
                # of the next step: quadratic at first, then as the last two; saves the step that would only confirm
                expected = QUADRATIC * moved * moved if count == 1 else moved * ti.min(moved / previous, 1.0)
            if expected > step[0, TOLERANCE]:
                failed += 1.0
            largest = ti.max(largest, change_of_column(Z, q, s, ny, nz))
            flux_a, flux_b = wall_slopes(Z, q, nz, D1)
            Z[q, KINDS * nz + QA], Z[q, KINDS * nz + QB] = transfer * flux_a, -transfer * flux_b
        out[c, 0], out[c, 1], out[c, 2] = largest, failed, clamped
