"""The film with temperatures: columns of nz Chebyshev-Lobatto nodes zeta = z/h from body a (0) to body b (1).

Table Z[column, slot]: a column is a block of W rows at one x, as on the finest level of the state table; a slot is one
quantity at one node of zeta, or one of the column. Sources: generalised Reynolds equation, Yang & Wen 1990; energy
equation, model.md section 6. In SI but for viscosities, which are over eta0, and densities, over rho_0.

With the stress of the Couette part tau = (u_b - u_a)/(h E0) b, E0 = int dzeta/eta, zeta_c = int zeta dzeta/eta / E0 and b what
the shear law leaves of the viscosity: u = u_a + (u_b - u_a) int_0 dzeta/eta / E0 + h^2 p_x int_0 (zeta - zeta_c)/eta dzeta / b.
"""

import taichi as ti

from tehl_taichi.kernels.fields import DLE, DLH, DMH, DMP, DX, DY, FLOOR, IE, ILAM, LE, MOB, QCP, QP, RHO, RHOC, TOUCH, H, P
from tehl_taichi.kernels.lanes import Flat, Table, V, W, above, below, cells
from tehl_taichi.physics.density import expansivity, rho_film
from tehl_taichi.physics.elementary import exp, log
from tehl_taichi.physics.heat import conductivity, heat_capacity
from tehl_taichi.physics.rheology import secant, shear_limit
from tehl_taichi.physics.viscosity import ln_eta

DP = 1e3  # Pa, step of the difference quotients in pressure
DT = 1e-2  # K, of those in temperature
FADE = 1e-4  # heat sources fade as P/(P + FADE) towards the cavitated outlet: switching them off at P = 0 cycles
QUADRATIC = 0.1  # 1/K: a Newton step of a column that changes T by d is followed by one of about 0.1 d^2 (beta/2 is 0.05)
WARM, HOT = 100.0, 900.0  # the temperature stays above the inlet's minus WARM, and below HOT (deg C)

# slots: nz numbers each from T on, then the single ones
# temperature, that of the last step and the one before; velocities; h int_0 rho (u, v, 1), the last one of the last two
# steps too; 1/eta, rho; temperature and pressure change at the departure points; temperature of the last round
T, TN, TNN, U, VY, MX, MY, MS, MSN, MSNN, NIE, NRHO, TS, PS, LAST = range(15)
KINDS = 15
BETA, THROUGH = VY, U  # the velocities' slots, used again in the energy step
# pressure of the last step and the one before (Pa); heat into the bodies; A of T_s = A + B q; stress of the Couette part;
# shear on the walls z = 0 and z = h
PN, PNN, QA, QB, AA, AB, TAU, XA, YA, XB, YB = range(11)
SINGLES = 11
# step[0, ...] of the kernels: rate = weight of the new state in d/dt (1/s); 1/dx, 1/dy (1/m); B of both bodies; tolerance (K)
# and iterations of a column; dt, dt with the step before (s); weights of these two states (adding up to 1)
RATE, INV_X, INV_Y, B_A, B_B, TOLERANCE, ITERATIONS, BACK, BACK_2, NEAR, FAR = range(11)
STEP_NUMBERS = 11

Coefficients = ti.types.ndarray(dtype=ti.f64, ndim=2)


@ti.func
def node_laws(Z: ti.template(), q, nz, oil: ti.template(), p, ln_eta0):
    """1/eta and rho at the nodes of a column."""
    for n in range(nz):
        t = Z[q, T * nz + n]
        Z[q, NIE * nz + n] = exp(ln_eta0 - ln_eta(oil, p, t))
        Z[q, NRHO * nz + n] = rho_film(oil, p, t)


@ti.func
def couette(Z: ti.template(), q, nz, C: ti.template(), zeta: ti.template(), rheology: ti.template(), p, h, slip, eta0):
    """E0 eta0, zeta_c, Newtonian stress and what the shear law leaves of it."""
    e0, e1 = V(0.0), V(0.0)
    for n in range(nz):
        w = C[nz - 1, n] * Z[q, NIE * nz + n]
        e0 += w
        e1 += zeta[n] * w
    newtonian = slip * eta0 / (h * e0)
    return e0, e1 / e0, newtonian, secant(rheology, newtonian, p)


@ti.func
def shear_integrals(Z: ti.template(), q, nz, n, C: ti.template(), zeta: ti.template(), centre):
    """int_0^zeta of 1/eta and of (zeta - zeta_c)/eta up to node n."""
    turn, flow = V(0.0), V(0.0)
    for m in range(nz):
        ie = C[n, m] * Z[q, NIE * nz + m]
        turn += ie
        flow += (zeta[m] - centre) * ie
    return turn, flow


@ti.func
def integrals(Z: ti.template(), q, nz, C: ti.template(), zeta: ti.template(), e0, centre, b, u_a, slip, u_m):
    """Mean density, density carried by the Couette flow, and 1/eta that the Poiseuille flow feels."""
    mean, carried, mobile = V(0.0), V(0.0), V(0.0)
    for n in range(nz):
        turn, flow = shear_integrals(Z, q, nz, n, C, zeta, centre)
        rho = C[nz - 1, n] * Z[q, NRHO * nz + n]
        mean += rho
        carried += rho * (u_a + slip * turn / e0)
        mobile -= rho * flow
    return mean, carried / u_m, 12.0 * mobile / (mean * b)


@ti.func
def sensitivity(rheology: ti.template(), newtonian, p, b):
    """1 + d ln b/d ln(Newtonian stress): d tau/d newtonian over b."""
    return (secant(rheology, newtonian * 1.001, p) * 1.001 - b) * 1000.0 / b


@ti.func
def store_laws(S: ti.template(), k, h, mean, carried, ie, inv_lambda):
    S[RHO, k], S[RHOC, k], S[IE, k], S[LE, k] = mean, carried, ie, -log(ie)
    S[MOB, k] = mean * h * h * h * inv_lambda


@ti.func
def store_slopes(S: ti.template(), k, h, floor, mean, carried, ie, thinning, rate):
    """From the values at P + DP; the film acts on the shear law too (DLH)."""
    S[DLE, k] = (-log(ie) - S[LE, k]) * rate
    S[QP, k], S[QCP, k] = (mean - S[RHO, k]) * rate * S[H, k], (carried - S[RHOC, k]) * rate * S[H, k]
    S[DMP, k] = S[MOB, k] * (mean / S[RHO, k] - 1.0) * rate
    free = S[H, k] > floor
    S[DMH, k] = ti.select(free, 3.0 * S[MOB, k] / h, V(0.0))
    S[DLH, k] = ti.select(free, (1.0 - thinning) / h, V(0.0))


@ti.kernel
def laws(S: ti.template(), Z: ti.template(), G: Table, C: Coefficients, zeta: Flat,
         nz: ti.i32, oil: ti.template(), rheology: ti.template(), p_H: ti.f64, h_scale: ti.f64, ln_eta0: ti.f64,
         u_a: ti.f64, slip: ti.f64, u_m: ti.f64, slopes: ti.template()):
    """RHO, RHOC, LE, IE, MOB of the finest level from pressure, film and the temperatures; slip = u_b - u_a. With slopes = 1
    their derivatives, which need the values."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        floor, eta0 = G[0, FLOOR], ti.exp(ln_eta0)
        for q in range(s * (nx + 1), (s + 1) * (nx + 1)):
            k = off + q
            p, h = S[P, k] * p_H + slopes * DP, ti.max(S[H, k], floor)
            node_laws(Z, q, nz, oil, p, ln_eta0)
            e0, centre, stress, b = couette(Z, q, nz, C, zeta, rheology, p, h * h_scale, slip, eta0)
            mean, carried, ie = integrals(Z, q, nz, C, zeta, e0, centre, b, u_a, slip, u_m)
            if ti.static(slopes):
                store_slopes(S, k, h, floor, mean, carried, ie, sensitivity(rheology, stress, p, b), p_H / DP)
            else:
                store_laws(S, k, h, mean, carried, ie, G[0, ILAM])


@ti.func
def limited(a, b):
    """Van Leer's mean of two one-sided gradients: 0 where they differ in sign."""
    both = a * b > 0.0
    return ti.select(both, 2.0 * a * b / ti.select(both, a + b, V(1.0)), V(0.0))


@ti.func
def slots_around(Z: ti.template(), q, slot, n2, s, ny):
    """Slot at j - 1 and j + 1; where there is no such row, at j."""
    here = Z[q, slot]
    lower, upper = here, here
    for u in ti.static(range(W)):
        j = s * W + u
        if j > 0:
            if ti.static(u > 0):
                lower[u] = here[u - 1]
            else:
                lower[u] = Z[q - n2, slot][W - 1]
        if j < ny:
            if ti.static(u < W - 1):
                upper[u] = here[u + 1]
            else:
                upper[u] = Z[q + n2, slot][0]
    return lower, upper


@ti.func
def gradients(S: ti.template(), k, i, nx, s, ny, n2, dx, dy):
    """dP/dX and dP/dY for velocities and heat, limited: central differences at the cavitation edge heat by hundreds of K."""
    x, y, here = V(0.0), V(0.0), S[P, k]
    if i > 0 and i < nx:
        x = limited(S[P, k + 1] - here, here - S[P, k - 1]) / dx
    if ny > 0:
        y = limited(above(S, P, k, n2) - here, here - below(S, P, k, n2)) / dy
        for u in ti.static(range(W)):
            if s * W + u == 0 or s * W + u >= ny:
                y[u] = 0.0
    wet = here > 0.0
    return ti.select(wet, x, V(0.0)), ti.select(wet, y, V(0.0))


@ti.kernel
def velocities(S: ti.template(), Z: ti.template(), G: Table, C: Coefficients, zeta: Flat,
               nz: ti.i32, oil: ti.template(), rheology: ti.template(), p_H: ti.f64, h_scale: ti.f64, a: ti.f64,
               ln_eta0: ti.f64, u_a: ti.f64, slip: ti.f64):
    """Velocities, mass fluxes below each node, and the shear on both walls."""
    nx, ny, off = cells(G, 0)
    base = KINDS * nz
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        floor, eta0, dx, dy = G[0, FLOOR], ti.exp(ln_eta0), G[0, DX], G[0, DY]
        for i in range(nx + 1):
            q = s * (nx + 1) + i
            k = off + q
            p, h = S[P, k] * p_H, ti.max(S[H, k], floor) * h_scale
            px, py = gradients(S, k, i, nx, s, ny, nx + 1, dx, dy)
            px, py = px * (p_H / a), py * (p_H / a)
            node_laws(Z, q, nz, oil, p, ln_eta0)
            e0, centre, newtonian, b = couette(Z, q, nz, C, zeta, rheology, p, h, slip, eta0)
            flow = h * h / (b * eta0)
            for n in range(nz):
                turn, poiseuille = shear_integrals(Z, q, nz, n, C, zeta, centre)
                Z[q, U * nz + n] = u_a + slip * turn / e0 + flow * px * poiseuille
                Z[q, VY * nz + n] = flow * py * poiseuille
            for n in range(nz):
                mass, along, across = V(0.0), V(0.0), V(0.0)
                for m in range(nz):
                    rho = C[n, m] * Z[q, NRHO * nz + m]
                    mass += rho
                    along += rho * Z[q, U * nz + m]
                    across += rho * Z[q, VY * nz + m]
                Z[q, MS * nz + n], Z[q, MX * nz + n], Z[q, MY * nz + n] = h * mass, h * along, h * across
            tau = b * newtonian
            Z[q, base + TAU] = tau
            Z[q, base + XA], Z[q, base + YA] = tau - centre * h * px, -centre * h * py
            Z[q, base + XB], Z[q, base + YB] = tau + (1.0 - centre) * h * px, (1.0 - centre) * h * py


@ti.func
def cubic(f):
    """Lagrange weights of the nodes -1, 0, 1, 2 at f."""
    return ti.Vector([-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2,
                      (f + 1) * f * (f - 1) / 6])


@ti.func
def along_x(Z: ti.template(), first, nx, slot, u, at, inflow):
    """Cubic interpolation at x = at (in cells) along row u of a block, within the two nearest values; inflow from the left."""
    i0 = int(ti.floor(at))
    w, out, low, high = cubic(at - i0), 0.0, 1e300, -1e300
    for t in ti.static(range(4)):
        i = i0 - 1 + t
        value = inflow
        if i >= 0:
            value = Z[first + ti.min(i, nx), slot][u]
        out += w[t] * value
        if ti.static(t == 1 or t == 2):
            low, high = ti.min(low, value), ti.max(high, value)
    return ti.min(ti.max(out, low), high)


@ti.func
def upwind(Z: ti.template(), q, slot, n2, s, ny, moved):
    """Change of a slot by flow along y, moved = v dt/dy."""
    here = Z[q, slot]
    lower, upper = slots_around(Z, q, slot, n2, s, ny)
    return -ti.max(moved, 0.0) * (here - lower) - ti.min(moved, 0.0) * (upper - here)


@ti.func
def origin(Z: ti.template(), q, s, i, nx, ny, nz, n, slot, step: ti.template(), back_by, inflow):
    """Slot at the place where the oil of node n was step[0, back_by] seconds ago."""
    out, n2, back, inv_x, inv_y = V(0.0), nx + 1, step[0, back_by], step[0, INV_X], step[0, INV_Y]
    for u in ti.static(range(W)):
        out[u] = along_x(Z, s * n2, nx, slot, u, i - Z[q, U * nz + n][u] * back * inv_x, inflow)
    if ny > 0:
        moved = ti.min(ti.max(Z[q, VY * nz + n] * back * inv_y, -1.0), 1.0)
        out += upwind(Z, q, slot, n2, s, ny, moved)
    return out


@ti.kernel
def departures(S: ti.template(), Z: ti.template(), G: Table, nz: ti.i32, p_H: ti.f64, inflow: ti.f64, step: Coefficients):
    """Temperature and pressure where the oil of each node was one and two steps ago (BDF2 along its path): cubic along x,
    upwind along y.

    inflow: temperature of what comes in from the left.
    """
    nx, ny, off = cells(G, 0)
    base = KINDS * nz
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        near, far = step[0, NEAR], step[0, FAR]
        for i in range(nx + 1):
            q = s * (nx + 1) + i
            for n in range(nz):
                warm = near * origin(Z, q, s, i, nx, ny, nz, n, TN * nz + n, step, BACK, inflow)
                press = near * origin(Z, q, s, i, nx, ny, nz, n, base + PN, step, BACK, 0.0)
                if far != 0.0:
                    warm += far * origin(Z, q, s, i, nx, ny, nz, n, TNN * nz + n, step, BACK_2, inflow)
                    press += far * origin(Z, q, s, i, nx, ny, nz, n, base + PNN, step, BACK_2, 0.0)
                Z[q, TS * nz + n] = warm
                Z[q, PS * nz + n] = S[P, off + q] * p_H - press


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
def prepare(Z: ti.template(), q, s, i, nx, ny, nz, oil: ti.template(), p, step: ti.template()):
    """What the Newton steps of a column share: the flow through its nodes and -d ln eta/d Gamma; keeps the last iterate."""
    total = outflow(Z, q, i, nx, s, ny, nz, nz - 1, step)
    for n in range(nz):
        t = Z[q, T * nz + n]
        share = Z[q, MS * nz + n] / Z[q, MS * nz + nz - 1]
        Z[q, BETA * nz + n] = (ln_eta(oil, p, t) - ln_eta(oil, p, t + DT)) / DT
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
def assemble(S: ti.template(), Z: ti.template(), X: ti.template(), k, q, s, nz, C: ti.template(), zeta: ti.template(),
             D1: ti.template(), D2: ti.template(), oil: ti.template(), rheology: ti.template(), p, h, px, py, ln_eta0, slip,
             rate, B_a, B_b, fade, mu_stress):
    """Newton system of one column: X[s, n nz + m] the matrix, X[s, nz nz + n] minus the residual."""
    base, eta0 = KINDS * nz, ti.exp(ln_eta0)
    kf = conductivity(oil, p)
    node_laws(Z, q, nz, oil, p, ln_eta0)
    e0, centre, newtonian, b = couette(Z, q, nz, C, zeta, rheology, p, h, slip, eta0)
    tau = b * newtonian
    bend = b * sensitivity(rheology, newtonian, p, b)  # d tau/d newtonian
    for n in range(1, nz - 1):
        t, rho, ie = Z[q, T * nz + n], Z[q, NRHO * nz + n], Z[q, NIE * nz + n]
        rc = heat_capacity(oil, p, t)
        swept = rc / rho * Z[q, THROUGH * nz + n] / h  # fluxes and rho are both over rho_0
        tx, ty = tau + (zeta[n] - centre) * h * px, (zeta[n] - centre) * h * py
        beta = Z[q, BETA * nz + n]
        heat = (tx * tx + ty * ty) * ie / (b * eta0) * fade
        squeeze = expansivity(oil, p, t) * Z[q, PS * nz + n] * rate * fade
        solid = S[TOUCH, k] > 0.0
        heat = ti.select(solid, mu_stress * ti.abs(slip) / h, heat)
        squeeze = ti.select(solid, V(0.0), squeeze)
        gain = ti.select(solid, V(0.0), ie / eta0 * (bend * newtonian + tau) * newtonian / e0 * fade)
        balance = rc * rate * (t - Z[q, TS * nz + n]) - heat - squeeze * (t + 273.15)
        for m in range(nz):
            other = Z[q, T * nz + m]
            link = swept * D1[n, m] - kf / (h * h) * D2[n, m]
            balance += link * other
            X[s, n * nz + m] = link + gain * C[nz - 1, m] * Z[q, NIE * nz + m] * Z[q, BETA * nz + m]
        X[s, n * nz + n] = X[s, n * nz + n] + rc * rate - squeeze - ti.select(solid, V(0.0), heat * beta)
        X[s, nz * nz + n] = -balance
    flux_a, flux_b = wall_slopes(Z, q, nz, D1)
    last = nz - 1
    for m in range(nz):
        X[s, m] = -B_a * kf / h * D1[0, m]
        X[s, last * nz + m] = B_b * kf / h * D1[last, m]
    X[s, 0] = X[s, 0] + 1.0
    X[s, last * nz + last] = X[s, last * nz + last] + 1.0
    X[s, nz * nz] = Z[q, base + AA] + B_a * kf / h * flux_a - Z[q, T * nz]
    X[s, nz * nz + last] = Z[q, base + AB] - B_b * kf / h * flux_b - Z[q, T * nz + last]


@ti.func
def eliminate(X: ti.template(), s, nz):
    """Solve the system in X[s] in place (conduction makes it safe without pivoting); the solution takes the right side."""
    rhs = nz * nz
    for c in range(nz):
        inv = 1.0 / X[s, c * nz + c]
        for r in range(c + 1, nz):
            f = X[s, r * nz + c] * inv
            for m in range(c + 1, nz):
                X[s, r * nz + m] = X[s, r * nz + m] - f * X[s, c * nz + m]  # (x -= y of a field would be atomic)
            X[s, rhs + r] = X[s, rhs + r] - f * X[s, rhs + c]
    for back in range(nz):
        c = nz - 1 - back
        total = X[s, rhs + c]
        for m in range(c + 1, nz):
            total -= X[s, c * nz + m] * X[s, rhs + m]
        X[s, rhs + c] = total / X[s, c * nz + c]


@ti.kernel
def energy(S: ti.template(), Z: ti.template(), X: ti.template(), G: Table, C: Coefficients,
           zeta: Flat, D1: Coefficients, D2: Coefficients, nz: ti.i32,
           oil: ti.template(), rheology: ti.template(), scale: Coefficients, step: Coefficients, out: Table):
    """One implicit step of every column, by Newton; out[block] = (largest change of T against the last iterate, columns
    that did not converge, clamped nodes).

    scale[0] = p_H, h, a, ln eta0, slip, inlet temperature, column of X = 0.
    """
    nx, ny, off = cells(G, 0)
    base = KINDS * nz
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        p_H, h_scale, a, ln_eta0, slip = scale[0, 0], scale[0, 1], scale[0, 2], scale[0, 3], scale[0, 4]
        floor, dx, dy, coldest = G[0, FLOOR], G[0, DX], G[0, DY], scale[0, 5] - WARM
        largest, failed, clamped = 0.0, 0.0, 0.0
        for i in range(nx + 1):
            q = s * (nx + 1) + i
            k = off + q
            p, h = S[P, k] * p_H, ti.max(S[H, k], floor) * h_scale
            px, py = gradients(S, k, i, nx, s, ny, nx + 1, dx, dy)
            fade = V(1.0)
            if i > scale[0, 6]:
                fade = S[P, k] / (S[P, k] + FADE)
            mu_stress = ti.min(rheology.mu_boundary * p, shear_limit(rheology, p))
            prepare(Z, q, s, i, nx, ny, nz, oil, p, step)
            moved, expected, count = 1e300, 1e300, 0
            while expected > step[0, TOLERANCE] and count < int(step[0, ITERATIONS]):
                count += 1
                previous = moved
                assemble(S, Z, X, k, q, s, nz, C, zeta, D1, D2, oil, rheology, p, h, px * (p_H / a), py * (p_H / a), ln_eta0,
                         slip, step[0, RATE], step[0, B_A], step[0, B_B], fade, mu_stress)
                eliminate(X, s, nz)
                moved = 0.0
                for n in range(nz):
                    change = ti.min(ti.max(X[s, nz * nz + n], -60.0), 60.0)
                    t = Z[q, T * nz + n] + change
                    Z[q, T * nz + n] = ti.min(ti.max(t, coldest), HOT)
                    for u in ti.static(range(W)):
                        if s * W + u <= ny:
                            moved = ti.max(moved, ti.abs(change[u]))
                            if t[u] > HOT or t[u] < coldest:
                                clamped += 1.0
                # of the next step: quadratic at first, then as the last two; saves the step that would only confirm
                expected = QUADRATIC * moved * moved if count == 1 else moved * ti.min(moved / previous, 1.0)
            if expected > step[0, TOLERANCE]:
                failed += 1.0
            for m in range(nz):
                before = ti.abs(Z[q, T * nz + m] - Z[q, LAST * nz + m])
                for u in ti.static(range(W)):
                    if s * W + u <= ny:
                        largest = ti.max(largest, before[u])
            flux_a, flux_b = wall_slopes(Z, q, nz, D1)
            kf = conductivity(oil, p)
            Z[q, base + QA], Z[q, base + QB] = kf / h * flux_a, -kf / h * flux_b
        out[s, 0], out[s, 1], out[s, 2] = largest, failed, clamped


@ti.kernel
def accept(S: ti.template(), Z: ti.template(), G: Table, nz: ti.i32, p_H: ti.f64):
    """The present state becomes that of the last step."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        for q in range(s * (nx + 1), (s + 1) * (nx + 1)):
            for n in range(nz):
                Z[q, TNN * nz + n], Z[q, TN * nz + n] = Z[q, TN * nz + n], Z[q, T * nz + n]
                Z[q, MSNN * nz + n], Z[q, MSN * nz + n] = Z[q, MSN * nz + n], Z[q, MS * nz + n]
            Z[q, KINDS * nz + PNN], Z[q, KINDS * nz + PN] = Z[q, KINDS * nz + PN], S[P, off + q] * p_H


@ti.kernel
def get_slots(Z: ti.template(), G: Table, first: ti.i32, count: ti.i32, out: ti.types.ndarray(dtype=ti.f64, ndim=3)):
    """out (count, ny+1, nx+1) = the slots from `first` on."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            for n in range(count):
                v = Z[s * (nx + 1) + i, first + n]
                for u in ti.static(range(W)):
                    if s * W + u <= ny:
                        out[n, s * W + u, i] = v[u]


@ti.kernel
def put_slots(Z: ti.template(), G: Table, first: ti.i32, count: ti.i32, values: ti.types.ndarray(dtype=ti.f64, ndim=3)):
    """The slots from `first` on = values (count, ny+1, nx+1); ghosts repeat the last row."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            for n in range(count):
                v = V(0.0)
                for u in ti.static(range(W)):
                    v[u] = values[n, ti.min(s * W + u, ny), i]
                Z[s * (nx + 1) + i, first + n] = v
