"""The film with temperatures: columns of nz Chebyshev-Lobatto nodes zeta = z/h from body a (0) to body b (1).

In the table of :mod:`tehl_taichi.heat.slots`. Source: generalised Reynolds equation, Yang & Wen 1990. In SI but for
viscosities, which are over eta0, and densities, over rho_0.

With the stress of the Couette part tau = (u_b - u_a)/(h E0) b, E0 = int dzeta/eta, zeta_c = int zeta dzeta/eta / E0 and b what
the shear law leaves of the viscosity: u = u_a + (u_b - u_a) int_0 dzeta/eta / E0 + h^2 p_x int_0 (zeta - zeta_c)/eta dzeta / b.
Integrals over zeta: w weights of the whole film, C[n] those up to node n, nested[n, m] = w[n] C[n, m].
"""

import taichi as ti

from tehl_taichi.engine.elementary import exp, log
from tehl_taichi.engine.lanes import Flat, Table, V, cells, tile, tiles
from tehl_taichi.heat.slots import KINDS, MS, MX, MY, NIE, NRHO, TAU, VY, XA, XB, YA, YB, T, U
from tehl_taichi.physics.density import rho_film
from tehl_taichi.physics.viscosity import ln_eta
from tehl_taichi.pressure.fields import DX, DY, FLOOR, ILAM, QCP, RHOC, H, P
from tehl_taichi.pressure.gradient import limited_gradient
from tehl_taichi.pressure.laws import DP, sheared, store_laws, store_slopes, store_thinning

Coefficients = ti.types.ndarray(dtype=ti.f64, ndim=2)


@ti.func
def node_laws(Z: ti.template(), q, nz, oil: ti.template(), p, ln_eta0):
    """1/eta and rho at the nodes of a column."""
    for n in range(nz):
        t = Z[q, T * nz + n]
        Z[q, NIE * nz + n] = exp(ln_eta0 - ln_eta(oil, p, t))
        Z[q, NRHO * nz + n] = rho_film(oil, p, t)


@ti.func
def couette(Z: ti.template(), q, nz, w: ti.template(), zeta: ti.template(), rheology: ti.template(), p, h, slip, eta0):
    """E0 eta0, zeta_c, Newtonian stress and what the shear law leaves of it."""
    e0, e1 = V(0.0), V(0.0)
    for n in range(nz):
        part = w[n] * Z[q, NIE * nz + n]
        e0 += part
        e1 += zeta[n] * part
    newtonian, b = sheared(rheology, p, h, e0, slip * eta0)
    return e0, e1 / e0, newtonian, b


@ti.func
def integrals(Z: ti.template(), q, nz, nested: ti.template(), w: ti.template(), zeta: ti.template(), e0, centre, b, u_a, slip,
              u_m):
    """Mean density, density carried by the Couette flow, and 1/eta that the Poiseuille flow feels."""
    mean, sheared, turned = V(0.0), V(0.0), V(0.0)
    for m in range(nz):
        above_m = V(0.0)  # of the density beyond node m, which its shear carries along
        for n in range(nz):
            above_m += nested[n, m] * Z[q, NRHO * nz + n]
        part = above_m * Z[q, NIE * nz + m]
        mean += w[m] * Z[q, NRHO * nz + m]
        sheared += part
        turned += (centre - zeta[m]) * part
    return mean, (u_a * mean + slip * sheared / e0) / u_m, 12.0 * turned / (mean * b)


@ti.kernel
def laws(S: ti.template(), Z: ti.template(), G: Table, nested: Coefficients, w: Flat, zeta: Flat,
         nz: ti.i32, oil: ti.template(), rheology: ti.template(), p_H: ti.f64, h_scale: ti.f64, ln_eta0: ti.f64,
         u_a: ti.f64, slip: ti.f64, u_m: ti.f64, slopes: ti.template()):
    """RHO, RHOC, LE, IE, ROOT, GAP of the finest level from pressure, film and the temperatures; slip = u_b - u_a. With
    slopes = 1 their derivatives, which need the values."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        floor, eta0 = G[0, FLOOR], ti.exp(ln_eta0)
        for q in range(s * (nx + 1) + first, s * (nx + 1) + last):
            k = off + q
            p, h = S[P, k] * p_H + slopes * DP, ti.max(S[H, k], floor)
            node_laws(Z, q, nz, oil, p, ln_eta0)
            e0, centre, stress, b = couette(Z, q, nz, w, zeta, rheology, p, h * h_scale, slip, eta0)
            mean, carried, ie = integrals(Z, q, nz, nested, w, zeta, e0, centre, b, u_a, slip, u_m)
            if ti.static(slopes):
                store_slopes(S, k, mean, -log(ie), p_H / DP)
                store_thinning(S, k, h, floor, rheology, p, stress, b)
                S[QCP, k] = (carried - S[RHOC, k]) * (p_H / DP) * S[H, k]
            else:
                store_laws(S, k, h, mean, -log(ie), ie, G[0, ILAM])
                S[RHOC, k] = carried


@ti.func
def shear_integrals(Z: ti.template(), q, nz, n, C: ti.template(), zeta: ti.template(), centre):
    """int_0^zeta of 1/eta and of (zeta - zeta_c)/eta up to node n."""
    turn, flow = V(0.0), V(0.0)
    for m in range(nz):
        ie = C[n, m] * Z[q, NIE * nz + m]
        turn += ie
        flow += (zeta[m] - centre) * ie
    return turn, flow


@ti.kernel
def velocities(S: ti.template(), Z: ti.template(), G: Table, C: Coefficients, w: Flat, zeta: Flat,
               nz: ti.i32, oil: ti.template(), rheology: ti.template(), p_H: ti.f64, h_scale: ti.f64, a: ti.f64,
               ln_eta0: ti.f64, u_a: ti.f64, slip: ti.f64):
    """Velocities, mass fluxes below each node, and the shear on both walls."""
    nx, ny, off = cells(G, 0)
    base = KINDS * nz
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        floor, eta0, dx, dy = G[0, FLOOR], ti.exp(ln_eta0), G[0, DX], G[0, DY]
        for i in range(first, last):
            q = s * (nx + 1) + i
            k = off + q
            p, h = S[P, k] * p_H, ti.max(S[H, k], floor) * h_scale
            px, py = limited_gradient(S, k, i, nx, s, ny, nx + 1, dx, dy)
            px, py = px * (p_H / a), py * (p_H / a)
            node_laws(Z, q, nz, oil, p, ln_eta0)
            e0, centre, newtonian, b = couette(Z, q, nz, w, zeta, rheology, p, h, slip, eta0)
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
