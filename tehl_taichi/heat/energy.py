"""Energy equation in the columns of a film (see :mod:`tehl_taichi.heat.film`), model.md section 6.

In time along the paths of the oil (BDF2); across the film implicit: conduction, both heat sources, both walls (T_s = A + B q of
the bodies) and the flow through the moving nodes form one Newton system per column.
"""

from tehl_taichi.engine.elementary import log, maximum, minimum
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import read
from tehl_taichi.engine.simd import Flat, Table, V, W, block_at, cells, tile, tiles
from tehl_taichi.heat.elimination import eliminate
from tehl_taichi.heat.film import keep_parts, node_laws, pressure_and_film
from tehl_taichi.heat.film_tables import (
    AA,
    AB,
    CHANGE,
    FAILED,
    HELD,
    HL,
    LAST,
    MS,
    MSN,
    MSNN,
    MX,
    MY,
    NIE,
    NRHO,
    PL,
    PS,
    PX,
    PY,
    QA,
    QB,
    RESTS,
    SA,
    SB,
    TS,
    VY,
    T,
    U,
    nodes_around,
)
from tehl_taichi.heat.heat_step import HeatStep
from tehl_taichi.heat.node_table import Nodes, second, slope, weight, zeta
from tehl_taichi.heat.sliding import SMALL, couette, crest, sheared, slipping, wall_stress
from tehl_taichi.laws.conduction import conductivity, heat_capacity
from tehl_taichi.laws.density import expansivity
from tehl_taichi.laws.sheared_flow import mean_stress
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.pressure.conditions import Conditions
from tehl_taichi.pressure.fields import IE, MASK, SKEW, TOUCH, P
from tehl_taichi.pressure.tractions import solid_friction

DT = 1e-2  # K, step of the difference quotient in temperature
RISE = 1e-3  # and of that in the Newtonian stress, a part of it
FADE = 1e-4  # heat sources fade as P/(P + FADE) towards the cavitated outlet: switching them off at P = 0 cycles
# The second Newton step of a column is expected to be at most this part of the first. By the square of the first (0.1 d^2/K)
# steps of up to 0.2 K were the last ones, also where they go to and fro: rounds of pressure and temperatures ended no sooner
# than by chance (an exit on 256x64x9, a window four times as fine: 192 and 155 temperature solves in 32 steps)
FIRST_LEAVES = 0.1
WARM, HOT = 100.0, 900.0  # the temperature stays above the inlet's minus WARM, and below HOT (deg C)
LONGEST = 60.0  # K, of a Newton step of a column
# Newton steps of a column with the -d ln eta/d Gamma that it began with, and what a step must leave of the one before, or the
# next are halved if they go to and fro. Where oil expands at the outlet it is cold in the middle and sheared in a hot band
# beside a wall, its -d ln eta/d Gamma three times that of the band: steps go to and fro by 0.01 to 100 K. Where oil begins
# to slip along a wall they creep, halved ones without an end
USUAL, SLUGGISH, LEAST = 3, 0.5, 1 / 16
LIGHT = 1e-3  # of p_H: eddies of the inlet, in a gap that nodes do not resolve, carry nothing: their columns may fail
BETA, THROUGH = VY, U  # the velocities' slots, used again once the departure points are known


@ti.dataclass
class EnergyColumn:
    """Quantities of a column in the energy equation, besides its flow."""

    p: V  # Pa
    h: V  # m, at least the floor
    px: V  # Pa/m
    py: V  # Pa/m
    skew: V  # fluidity for the flow by pressure over that of the Couette flow
    e0: V  # int dzeta/eta over 1/eta0 of the temperatures that the pressure was solved for
    k: V  # W/mK, conductivity
    fade: V  # part of the film's heat sources that counts
    touch: V  # 1 where boundary friction heats instead of the film,
    friction: V  # by so many W/m3


@ti.dataclass
class EnergyNode:
    """A node of a column."""

    ie: V  # 1/(Pa s), 1/eta
    lever: V  # m, z - z_c
    swell: V  # W/m3K, expansivity times dp/dt along the path


@ti.dataclass
class Sources:
    """Heat sources at a node, and their derivatives by the temperatures."""

    viscous: V  # W/m3, dissipation of the film
    heat: V  # W/m3, that or boundary friction
    squeeze: V  # W/m3K, compression heat over the absolute temperature
    gain: V  # W/m3, minus d heat/d e0 by way of the stress


@ti.func
def same_place(at: ti.template(), moved):
    """Column that was at this place when the grid had still to move by `moved` cells."""
    return at.q - at.i + ti.min(ti.max(at.i + int(moved), 0), at.nx)


@ti.func
def outflow(Z: ti.template(), at: ti.template(), nz, n, step: ti.template()):
    """Flow rho w relative to the moving nodes: -(d/dt, d/dx, d/dy) of the mass (flux) below node n."""
    q, left, right = at.q, ti.min(at.i, 1), ti.min(at.nx - at.i, 1)
    last, before = same_place(at, step.moved), same_place(at, step.moved_2)
    out = (Z[MS, q * nz + n] - step.near * Z[MSN, last * nz + n] - step.far * Z[MSNN, before * nz + n]) * step.rate
    out += (Z[MX, (q + right) * nz + n] - Z[MX, (q - left) * nz + n]) * (step.inv_x / (left + right))
    if at.ny > 0:
        lower, upper = nodes_around(Z, at, MY, nz, n)
        for u in ti.static(range(W)):
            j = at.s * W + u
            if j == 0:
                out[u] += upper[u] * step.inv_y  # odd about a mirror
            elif j == at.ny:
                out[u] -= lower[u] * step.inv_y
            elif j < at.ny:
                out[u] += 0.5 * (upper[u] - lower[u]) * step.inv_y
    return -out


@ti.func
def prepare(Z: ti.template(), at: ti.template(), nz, oil: ti.template(), p, ln_eta0, step: ti.template()):
    """Compute the values that all Newton steps of a column share: the flow through its nodes and -d ln eta/d Gamma; stores the
    last iterate.
    """
    q, total = at.q, outflow(Z, at, nz, nz - 1, step)
    thinning(Z, q, nz, oil, p, ln_eta0)
    for n in range(nz):
        share = Z[MS, q * nz + n] / Z[MS, q * nz + nz - 1]
        Z[THROUGH, q * nz + n] = outflow(Z, at, nz, n, step) - share * total
        Z[LAST, q * nz + n] = Z[T, q * nz + n]


@ti.func
def thinning(Z: ti.template(), q, nz, oil: ti.template(), p, ln_eta0):
    """Compute -d ln eta/d Gamma at the nodes of a column."""
    for n in range(nz):
        Z[BETA, q * nz + n] = (ln_eta0 - log(Z[NIE, q * nz + n]) - ln_eta(oil, p, Z[T, q * nz + n] + DT)) / DT


@ti.func
def heated(S: ti.template(), C: ti.template(), G: ti.template(), at: ti.template(), oil: ti.template(),
           rheology: ti.template(), scene: ti.template()):
    """The EnergyColumn at a place."""
    p, h = pressure_and_film(S, G, at.k, scene)
    fade = V(1.0)
    if at.i > scene.centre:
        fade = S[P, at.k] / (S[P, at.k] + FADE)
    friction = -scene.u_s * solid_friction(rheology, p, scene.u_s) / h
    return EnergyColumn(p=p, h=h, px=C[at.q, PX], py=C[at.q, PY], skew=S[SKEW, at.k], e0=S[IE, at.k] / S[SKEW, at.k],
                  k=conductivity(oil, p), fade=fade, touch=S[TOUCH, at.k],
                  friction=friction)


@ti.dataclass
class Work:
    """Work of the shear in a column, over its 1/eta.

    Stresses (Pa) by the sliding, and by lever times the gradients along and across it; derivative of the first one's square by
    ln of the Newtonian stress; heat of the slip along one wall, W/m2, with its derivative by e0; heat along both walls.
    """

    sliding: V
    along: V
    across: V
    bend: V
    slip: V
    slip_e0: V
    both: V


@ti.func
def inside_film(tau, newtonian, slip):
    """Work of the sliding inside the film, over 1/eta: of the part that does not slip along a wall."""
    return tau * newtonian * (1.0 - slip)


@ti.func
def work(rheology: ti.template(), col: ti.template(), flow: ti.template(), scene: ti.template()):
    """The Work of a column. Together its heats are tau u_s + p_x q, where q is the flow driven by the gradient.

    Where oil slips along a wall, the derivative is that at a constant rate: at a constant stress Newton steps alternate between
    films with and without slip. The flow driven by the pressure is that of the mass balance, whatever the temperatures: if it
    rose with them, hot walls would heat without limit.
    """
    law = sheared(rheology, col, flow, scene)
    wall = wall_stress(col, col.px, scene)
    strain, raised = wall * col.skew, flow.newtonian * (1.0 + RISE)
    inside = inside_film(law.tau, flow.newtonian, law.slip)
    more = inside_film(mean_stress(rheology, strain, raised, col.p), raised, slipping(rheology, wall, col.skew, raised, col.p))
    held, part, driven = law.tau + wall, law.slip, col.e0 / flow.e0
    return Work(sliding=flow.sign * ti.sqrt(inside), along=ti.sqrt(law.along * driven), across=ti.sqrt(law.across * driven),
                bend=ti.select(part > 0.0, inside, (more - inside) / RISE), slip=held * ti.abs(scene.u_s) * part,
                slip_e0=held * ti.abs(scene.u_s) * ti.select(part > 0.0, 1.0 - part, V(0.0)) / flow.e0,
                both=col.h**3 * col.e0 * col.skew / (12.0 * scene.eta0) * (
                    law.more_x * col.px * col.px + law.more_y * col.py * col.py))


@ti.func
def sources(node: ti.template(), col: ti.template(), flow: ti.template(), done: ti.template()):
    """The Sources at a node."""
    solid = col.touch > 0.0
    along, across = node.lever * col.px * done.along, node.lever * col.py * done.across
    tx, driven = done.sliding + along, along * along + across * across + done.sliding * along
    viscous = ti.select(solid, V(0.0), (tx * tx + across * across) * node.ie * col.fade)
    gain = node.ie * (done.bend + driven) / flow.e0 * col.fade
    return Sources(viscous=viscous, heat=ti.select(solid, col.friction, viscous),
                   squeeze=ti.select(solid, V(0.0), node.swell * col.fade), gain=ti.select(solid, V(0.0), gain))


@ti.func
def one_sided(N: ti.template(), n, swept, conduction):
    """Part of the flow through node n that uses a one-sided slope towards its origin: from convection of twice the conduction
    on, fully from four times.

    Nine nodes do not resolve a fast flow across the film: in the eddies of the inlet of a cold film, polynomials through them
    oscillate by hundreds of K.
    """
    distance = ti.select(swept > 0.0, zeta(N, n) - zeta(N, n - 1), zeta(N, n + 1) - zeta(N, n))
    return minimum(maximum(0.5 * ti.abs(swept) * distance / conduction - 1.0, 0.0), 1.0)


@ti.func
def turn_upstream(Z: ti.template(), X: ti.template(), N: ti.template(), at: ti.template(), n, swept):
    """Add `swept`, a part of the flow through node n with a one-sided slope, to row n of the matrix. Returns its contribution
    to the balance.
    """
    q, c, nz, balance = at.q, at.c, N.shape[1], V(0.0)
    for side in ti.static((-1, 1)):
        brought = maximum(-side * swept, 0.0) * (1.0 / ti.abs(zeta(N, n + side) - zeta(N, n)))
        balance += brought * (Z[T, q * nz + n] - Z[T, q * nz + n + side])
        X[c, n * nz + n] = X[c, n * nz + n] + brought
        X[c, n * nz + n + side] = X[c, n * nz + n + side] - brought
    return balance


@ti.func
def assemble(Z: ti.template(), C: ti.template(), X: ti.template(), N: ti.template(), at: ti.template(), col: ti.template(),
             oil: ti.template(), rheology: ti.template(), scene: ti.template(), step: ti.template()):
    """Assemble the Newton equations of the inner nodes, see :mod:`elimination`; the right side is minus the residual."""
    q, c, nz = at.q, at.c, N.shape[1]
    flow = couette(Z, N, q, col.h, scene)
    done = work(rheology, col, flow, scene)
    conduction, by_node = col.k / (col.h * col.h), nz * (nz + 1)
    for m in range(nz):  # how the heat of every node depends on the temperature of node m, through the stress: times gain
        X[c, by_node + m] = weight(N, m) * Z[NIE, q * nz + m] * Z[BETA, q * nz + m]
    for n in range(1, nz - 1):
        t = Z[T, q * nz + n]
        storing = heat_capacity(oil, col.p, t)
        swept = storing / Z[NRHO, q * nz + n] * Z[THROUGH, q * nz + n] / col.h  # fluxes and rho are both over rho_0
        node = EnergyNode(ie=Z[NIE, q * nz + n] / scene.eta0, lever=(zeta(N, n) - flow.centre) * col.h,
                    swell=expansivity(oil, col.p, t) * Z[PS, q * nz + n] * step.rate)
        made = sources(node, col, flow, done)
        balance = storing * step.rate * (t - Z[TS, q * nz + n]) - made.heat - made.squeeze * (t + 273.15)
        turned = one_sided(N, n, swept, conduction) * swept
        for m in range(nz):
            link = (swept - turned) * slope(N, n, m) - conduction * second(N, n, m)
            balance += link * Z[T, q * nz + m]
            X[c, n * nz + m] = link + made.gain * X[c, by_node + m]
        X[c, n * nz + n] = X[c, n * nz + n] + storing * step.rate - made.squeeze - made.viscous * Z[BETA, q * nz + n]
        if ti.abs(turned).max() > 0.0:
            balance += turn_upstream(Z, X, N, at, n, turned)
        X[c, nz * nz + n] = -balance
    assemble_slip(X, C, N, at, col, flow, done, crest(rheology, col.p), step)


@ti.func
def assemble_slip(X: ti.template(), C: ti.template(), N: ti.template(), at: ti.template(), col: ti.template(),
                  flow: ti.template(), done: ti.template(), crest, step: ti.template()):
    """Add the heat of wall slip to the equation of the wall with the larger stress, at a pressure crest to both; stored in
    C.
    """
    c, q, nz, last = at.c, at.q, N.shape[1], N.shape[1] - 1
    counts = ti.select(col.touch > 0.0, V(0.0), col.fade)
    more_at_b = 0.5 * flow.sign * col.h * col.px / maximum(crest, SMALL)
    at_b = minimum(maximum(0.5 + 0.5 * more_at_b, 0.0), 1.0)
    to_a, to_b = (1.0 - at_b) * counts, at_b * counts
    shared = 0.5 * counts * done.both
    C[q, SA], C[q, SB] = to_a * done.slip + shared, to_b * done.slip + shared
    for m in range(nz):
        falls = done.slip_e0 * X[c, nz * (nz + 1) + m]
        X[c, m], X[c, last * nz + m] = step.B_a * to_a * falls, step.B_b * to_b * falls


@ti.func
def wall_slopes(Z: ti.template(), N: ti.template(), q):
    """dT/dzeta at both walls."""
    nz, at_a, at_b = N.shape[1], V(0.0), V(0.0)
    for m in range(nz):
        at_a += slope(N, 0, m) * Z[T, q * nz + m]
        at_b += slope(N, nz - 1, m) * Z[T, q * nz + m]
    return at_a, at_b


@ti.func
def assemble_walls(Z: ti.template(), C: ti.template(), X: ti.template(), N: ti.template(), at: ti.template(), transfer,
                   step: ti.template()):
    """Assemble the equations of both walls, T_s = A + B q, after :func:`assemble`; transfer: conductivity over film
    thickness.
    """
    q, c, nz = at.q, at.c, N.shape[1]
    last = nz - 1
    flux_a, flux_b = wall_slopes(Z, N, q)
    for m in range(nz):
        X[c, m] = X[c, m] - step.B_a * transfer * slope(N, 0, m)
        X[c, last * nz + m] = X[c, last * nz + m] + step.B_b * transfer * slope(N, last, m)
    X[c, 0] = X[c, 0] + 1.0
    X[c, last * nz + last] = X[c, last * nz + last] + 1.0
    X[c, nz * nz] = C[q, AA] + step.B_a * (transfer * flux_a + C[q, SA]) - Z[T, q * nz]
    X[c, nz * nz + last] = C[q, AB] - step.B_b * (transfer * flux_b - C[q, SB]) - Z[T, q * nz + last]


@ti.func
def update(Z: ti.template(), X: ti.template(), at: ti.template(), nz, coldest, part, solved):
    """Add this part of the Newton step to the temperatures of the rows with `solved` = 1.

    Returns the largest change (K) of the whole step, its sum over the nodes of each row, and the number of nodes limited to the
    allowed range.
    """
    moved, total, held = V(0.0), V(0.0), V(0.0)
    for n in range(nz):
        change = ti.select(solved > 0.0, minimum(maximum(X[at.c, nz * nz + n], -LONGEST), LONGEST), V(0.0))
        t = Z[T, at.q * nz + n] + part * change
        Z[T, at.q * nz + n] = minimum(maximum(t, coldest), HOT)
        moved, total = maximum(moved, ti.abs(change)), total + change
        held += ti.select(t > HOT, V(1.0), ti.select(t < coldest, V(1.0), V(0.0)))
    return largest_row(moved, at), total, sum_of_rows(held, at)


@ti.func
def keep_even(X: ti.template(), c, nz):
    """Keep what is even across the film of the Newton step of a column.

    Rolling between equal bodies is the same at both walls. What rounding leaves of an odd part grows behind a front, until the
    hot layer is at one wall, and rounds with the pressure go to and fro between such solutions.
    """
    for n in range((nz + 1) // 2):
        low, high = nz * nz + n, nz * nz + nz - 1 - n
        mean = 0.5 * (X[c, low] + X[c, high])
        X[c, low], X[c, high] = mean, mean


@ti.func
def largest_row(values, at: ti.template()):
    """Row with the largest of values >= 0, without ghosts."""
    out = 0.0
    for u in ti.static(range(W)):
        if at.s * W + u <= at.ny:
            out = ti.max(out, values[u])
    return out


@ti.func
def sum_of_rows(values, at: ti.template()):
    out = 0.0
    for u in ti.static(range(W)):
        if at.s * W + u <= at.ny:
            out += values[u]
    return out


@ti.func
def change_of_column(Z: ti.template(), at: ti.template(), nz, counts):
    """Largest change (K) from the last iterate; counts: 1 in the rows to include, else 0."""
    change = V(0.0)
    for n in range(nz):
        change = maximum(change, ti.abs(Z[T, at.q * nz + n] - Z[LAST, at.q * nz + n]))
    return largest_row(change * counts, at)


@ti.func
def paced(part, turned):
    """Part of the next Newton step to take: half if steps alternate (turned < 0), more if they creep."""
    return ti.max(0.5 * part, LEAST) if turned < 0.0 else ti.min(2.0 * part, 1.0)


@ti.func
def solve_column(Z: ti.template(), C: ti.template(), X: ti.template(), N: ti.template(), at: ti.template(),
                 col: ti.template(), oil: ti.template(), rheology: ti.template(), scene: ti.template(), step: ti.template(),
                 solved):
    """Solve the temperatures of a column by Newton, in the rows with `solved` = 1. Returns 1.0 if they did not converge under
    load, and the number of nodes limited to the allowed range.
    """
    nz = N.shape[1]
    moved, expected, part, count, clamped, failed, went = 1e300, 1e300, 1.0, 0, 0.0, 0.0, V(0.0)
    while expected > step.tolerance and count < int(step.iterations):
        if count > 0:
            node_laws(Z, at.q, nz, oil, col.p, scene.ln_eta0)
        if count >= USUAL:
            thinning(Z, at.q, nz, oil, col.p, scene.ln_eta0)
        count += 1
        assemble(Z, C, X, N, at, col, oil, rheology, scene, step)
        assemble_walls(Z, C, X, N, at, col.k / col.h, step)
        eliminate(X, at.c, nz)
        if step.even > 0.0:
            keep_even(X, at.c, nz)
        previous, before = moved, went
        moved, went, held = update(Z, X, at, nz, scene.inlet - WARM, part, solved)
        keep_parts(Z, at.q, nz, oil)
        clamped += held
        if SLUGGISH * previous < moved and previous < LONGEST:
            part = paced(part, sum_of_rows(went * before, at))
        # of the next step: as the last two, saves the step that would only confirm
        expected = FIRST_LEAVES * moved if count == 1 else moved * ti.min(moved / previous, 1.0)
    if expected > step.tolerance and largest_row(col.p * solved, at) > LIGHT * scene.p_H:
        failed = 1.0
    return failed, clamped


@ti.func
def keep_departed(Z: ti.template(), at: ti.template(), nz, oil: ti.template()):
    """Set temperatures to those at the departure points, where a column has no others; returns the number of nodes."""
    for n in range(nz):
        Z[T, at.q * nz + n] = Z[TS, at.q * nz + n]
    keep_parts(Z, at.q, nz, oil)
    return 1.0 * nz * W


@ti.kernel
def energy(S: ti.template(), Z: ti.template(), C: ti.template(), X: ti.template(), G: Table, N: Nodes, oil: ti.template(),
           rheology: ti.template(), conditions: Flat, numbers: Flat, report: Table):
    """One implicit step of every column of the tiles that are not skipped, by Newton, after velocities and departures; report:
    see :mod:`tehl_taichi.heat.film_tables`.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        if report[c, RESTS] > 0.0:
            continue
        s, first, last = tile(c, nx)
        scene, step, nz = read(Conditions, conditions), read(HeatStep, numbers), N.shape[1]
        change, failed, clamped = 0.0, 0.0, 0.0
        for i in range(first, last):
            at = block_at(G, c, i)
            col = heated(S, C, G, at, oil, rheology, scene)
            prepare(Z, at, nz, oil, col.p, scene.ln_eta0, step)
            solved = 1.0 - step.given * (1.0 - S[MASK, at.k])
            lost, held = solve_column(Z, C, X, N, at, col, oil, rheology, scene, step, solved)
            if lost * step.hold > 0.0:
                lost, held = 0.0, keep_departed(Z, at, nz, oil)
            else:
                counts = ti.select(col.p > LIGHT * scene.p_H * step.hold, V(1.0), V(1.0 - step.hold))
                change = ti.max(change, change_of_column(Z, at, nz, counts))
            failed, clamped = failed + lost, clamped + held
            transfer = col.k / col.h
            flux_a, flux_b = wall_slopes(Z, N, at.q)
            C[at.q, QA], C[at.q, QB] = transfer * flux_a + C[at.q, SA], C[at.q, SB] - transfer * flux_b
            C[at.q, PL], C[at.q, HL] = col.p, col.h
        report[c, CHANGE], report[c, FAILED], report[c, HELD] = change, failed, clamped
