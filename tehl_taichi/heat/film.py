"""Thermal film: columns of nz Chebyshev-Lobatto nodes zeta = z/h from body a (0) to body b (1).

In the table of :mod:`tehl_taichi.heat.film_tables`. Source: generalised Reynolds equation, Yang & Wen 1990. In SI, except
viscosities (over eta0) and densities (over rho_0).

Newtonian stress of the Couette part -u_s/(h E0), u_s = u_a - u_b, E0 = int dzeta/eta, zeta_c = int zeta dzeta/eta / E0; Phi:
factor of the shear law on the pressure-driven flow (:mod:`tehl_taichi.heat.sliding`): u = u_a - u_s int_0 dzeta/eta / E0 + Phi
h^2 p_x int_0 (zeta - zeta_c)/eta dzeta. Integrals over zeta: N, see :mod:`tehl_taichi.heat.node_table`.
"""

from tehl_taichi.engine.elementary import exp, log, maximum
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import read
from tehl_taichi.engine.simd import Flat, Table, V, block_at, cells, tile, tiles
from tehl_taichi.heat.film_tables import KEPT, MS, MX, MY, NIE, NRHO, PX, PY, RESTS, TAU, VY, XA, XB, YA, YB, T, U
from tehl_taichi.heat.node_table import Nodes, beyond, integral, weight, zeta
from tehl_taichi.heat.sliding import couette, sheared
from tehl_taichi.laws.density import rho_film
from tehl_taichi.laws.rheology import DP
from tehl_taichi.laws.sheared_flow import wall_limit
from tehl_taichi.laws.viscosity import ln_eta_of, part, parts
from tehl_taichi.pressure.conditions import Conditions
from tehl_taichi.pressure.fields import DSKEW, FLOOR, ILAM, QCP, RHOC, SKEW, H, P
from tehl_taichi.pressure.gradient import limited_gradient
from tehl_taichi.pressure.isothermal_laws import store_laws, store_slopes
from tehl_taichi.pressure.tractions import walls


@ti.dataclass
class FilmColumn:
    """Quantities of a column that its nodes share."""

    p: V  # Pa
    h: V  # m, at least the floor
    px: V  # Pa/m
    py: V  # Pa/m
    skew: V  # fluidity for the flow by pressure over E0


@ti.func
def pressure_and_film(S: ti.template(), G: ti.template(), k, scene: ti.template()):
    """Pressure (Pa) and film thickness (m, at least the floor)."""
    return S[P, k] * scene.p_H, maximum(S[H, k], G[0, FLOOR]) * scene.h


@ti.func
def column(S: ti.template(), G: ti.template(), at: ti.template(), scene: ti.template()):
    """The FilmColumn at a place, from pressure and film."""
    px, py = limited_gradient(S, G, at)
    p, h = pressure_and_film(S, G, at.k, scene)
    slope = scene.p_H / scene.a
    return FilmColumn(p=p, h=h, px=px * slope, py=py * slope, skew=S[SKEW, at.k])


@ti.func
def node_laws(Z: ti.template(), q, nz, oil: ti.template(), p, ln_eta0):
    """Compute 1/eta and rho at the nodes of a column, after :func:`keep_parts`."""
    for n in range(nz):
        at = q * nz + n
        known = [Z[KEPT + m, at] for m in ti.static(range(parts(oil)))]
        Z[NIE, at] = exp(ln_eta0 - ln_eta_of(oil, p, Z[T, at], known))
        Z[NRHO, at] = rho_film(oil, p, Z[T, at])


@ti.func
def keep_parts(Z: ti.template(), q, nz, oil: ti.template()):
    """Store the viscosity terms that depend only on the temperature, at the nodes of a column, after it has changed."""
    for n in range(nz):
        for m in ti.static(range(parts(oil))):
            Z[KEPT + m, q * nz + n] = part(oil, Z[T, q * nz + n], m)


@ti.kernel
def keep(Z: ti.template(), G: Table, nz: ti.i32, oil: ti.template()):
    """:func:`keep_parts` of all columns."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        for q in range(s * (nx + 1) + first, s * (nx + 1) + last):
            keep_parts(Z, q, nz, oil)


@ti.func
def felt(Z: ti.template(), N: ti.template(), q, flow: ti.template(), scene: ti.template()):
    """Mean values of a column for the Reynolds equation: mean density, density in the Couette flow, 1/eta in the Poiseuille
    flow of Newtonian oil.
    """
    nz, mean, carried, turned = N.shape[1], V(0.0), V(0.0), V(0.0)
    for m in range(nz):
        above_m = V(0.0)  # of the density beyond node m, which its shear carries along
        for n in range(nz):
            above_m += beyond(N, m, n) * Z[NRHO, q * nz + n]
        part = above_m * Z[NIE, q * nz + m]
        mean += weight(N, m) * Z[NRHO, q * nz + m]
        carried += part
        turned += (flow.centre - zeta(N, m)) * part
    return mean, (scene.u_a * mean - scene.u_s * carried / flow.e0) / scene.u_m, 12.0 * turned / mean


@ti.kernel
def laws(S: ti.template(), Z: ti.template(), G: Table, N: Nodes, oil: ti.template(), conditions: Flat, slopes: ti.template()):
    """Compute RHO, RHOC, LE, IE, ROOT, GAP, SKEW of the finest level from pressure, film and temperatures; with slopes = 1
    their derivatives, which need the values.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        scene, floor, nz = read(Conditions, conditions), G[0, FLOOR], N.shape[1]
        for q in range(s * (nx + 1) + first, s * (nx + 1) + last):
            k = off + q
            p, h = S[P, k] * scene.p_H + slopes * DP, maximum(S[H, k], floor)
            node_laws(Z, q, nz, oil, p, scene.ln_eta0)
            flow = couette(Z, N, q, h * scene.h, scene)
            mean, carried, ie = felt(Z, N, q, flow, scene)
            if ti.static(slopes):
                store_slopes(S, k, mean, -log(ie), scene.p_H / DP)
                S[DSKEW, k] = (ie / flow.e0 - S[SKEW, k]) * (scene.p_H / DP)
                S[QCP, k] = (carried - S[RHOC, k]) * (scene.p_H / DP) * S[H, k]
            else:
                store_laws(S, k, h, mean, -log(ie), ie, G[0, ILAM])
                S[RHOC, k], S[SKEW, k] = carried, ie / flow.e0


@ti.func
def store_velocities(Z: ti.template(), N: ti.template(), q, col: ti.template(), flow: ti.template(), law: ti.template(),
                     scene: ti.template()):
    """Store u and v at the nodes; needs their 1/eta."""
    nz, poiseuille = N.shape[1], col.h * col.h / scene.eta0
    along = poiseuille * (law.along + law.slips + law.more_x) * col.px
    across = poiseuille * (law.across + law.more_y) * col.py
    for n in range(nz):
        turn, driven = V(0.0), V(0.0)  # int_0^zeta of 1/eta, and of (zeta - zeta_c)/eta
        for m in range(nz):
            ie = integral(N, n, m) * Z[NIE, q * nz + m]
            turn += ie
            driven += (zeta(N, m) - flow.centre) * ie
        Z[U, q * nz + n] = scene.u_a - scene.u_s * turn / flow.e0 + along * driven
        Z[VY, q * nz + n] = across * driven


@ti.func
def store_fluxes(Z: ti.template(), N: ti.template(), q, h):
    """Store the mass fluxes below each node; needs rho and the velocities."""
    nz = N.shape[1]
    for n in range(nz):
        along, across = V(0.0), V(0.0)
        for m in range(nz):
            rho = integral(N, n, m) * Z[NRHO, q * nz + m]
            along += rho * Z[U, q * nz + m]
            across += rho * Z[VY, q * nz + m]
        Z[MX, q * nz + n], Z[MY, q * nz + n] = h * along, h * across


@ti.func
def store_mass(Z: ti.template(), N: ti.template(), q, h):
    """Store the mass below each node; needs rho."""
    nz = N.shape[1]
    for n in range(nz):
        mass = V(0.0)
        for m in range(nz):
            mass += integral(N, n, m) * Z[NRHO, q * nz + m]
        Z[MS, q * nz + n] = h * mass


@ti.func
def store_shear(C: ti.template(), q, col: ti.template(), flow: ti.template(), law: ti.template(), limit):
    """Store the stress of the Couette part, the pressure gradient, and tau on both walls."""
    tau, x, y = flow.sign * law.tau, 0.5 * col.h * col.px, 0.5 * col.h * col.py
    shift = 1.0 - 2.0 * flow.centre  # of the middle of the film
    a_x, a_y, b_x, b_y = walls(tau + shift * x, x, shift * y, y, limit)
    C[q, TAU], C[q, PX], C[q, PY] = tau, col.px, col.py
    C[q, XA], C[q, YA], C[q, XB], C[q, YB] = a_x, a_y, -b_x, -b_y


@ti.kernel
def velocities(S: ti.template(), Z: ti.template(), C: ti.template(), G: Table, N: Nodes, oil: ti.template(),
               rheology: ti.template(), conditions: Flat, report: Table, flows: ti.i32):
    """Store the mass below each node and the shear on both walls, which belong to a state; with `flows` = 1 also velocities and
    mass fluxes, in tiles that are not skipped.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        if report[c, RESTS] > 0.0:
            continue
        s, first, last = tile(c, nx)
        scene, nz = read(Conditions, conditions), N.shape[1]
        for i in range(first, last):
            at = block_at(G, c, i)
            col = column(S, G, at, scene)
            node_laws(Z, at.q, nz, oil, col.p, scene.ln_eta0)
            flow = couette(Z, N, at.q, col.h, scene)
            law = sheared(rheology, col, flow, scene)
            if flows:
                store_velocities(Z, N, at.q, col, flow, law, scene)
                store_fluxes(Z, N, at.q, col.h)
            store_mass(Z, N, at.q, col.h)
            store_shear(C, at.q, col, flow, law, wall_limit(rheology, col.p))
