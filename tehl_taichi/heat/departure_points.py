"""Origin of the oil in a film: values one and two steps ago at the departure points of its nodes."""

from tehl_taichi.engine.elementary import maximum, minimum, within
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import read
from tehl_taichi.engine.simd import Flat, Table, V, W, block_at, cells, columns_around, rows_around, tile, tiles
from tehl_taichi.heat.film_tables import MS, MSN, MSNN, PN, PNN, PS, RESTS, TN, TNN, TS, VY, T, U
from tehl_taichi.heat.heat_step import HeatStep
from tehl_taichi.pressure.conditions import Conditions
from tehl_taichi.pressure.fields import P


@ti.func
def cubic(f):
    """Lagrange weights of the nodes -1, 0, 1, 2 at f."""
    return (-f * (f - 1.0) * (f - 2.0) / 6.0, (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0, -(f + 1.0) * f * (f - 2.0) / 2.0,
            (f + 1.0) * f * (f - 1.0) / 6.0)


@ti.dataclass
class EarlierState:
    """An earlier state at a node: kind of its temperature, its number, pressure of its column, its age, and the displacement of
    the grid (cells) since.
    """

    warm: ti.i32
    node: ti.i32
    press: ti.i32
    seconds: ti.f64
    moved: ti.f64


@ti.func
def along_x(Z: ti.template(), C: ti.template(), nz, at: ti.template(), past: ti.template(), x, inflow):
    """Temperature and pressure of an earlier state in a block of rows at x (in cells): cubic, within the two nearest values.

    Inflow from the left has temperature `inflow` and pressure 0. Rows from one cell, as nearly all neighbours are, are
    interpolated together.
    """
    i0 = int(ti.floor(x[0]))
    together = 1
    for u in ti.static(range(1, W)):
        if int(ti.floor(x[u])) != i0:
            together = 0
    T0, p0 = V(0.0), V(0.0)
    if together == 1:
        T0, p0 = from_cell(Z, C, nz, at, past, i0, x - i0, inflow)
    else:
        for u in ti.static(range(W)):
            i = int(ti.floor(x[u]))
            T, p = from_cell(Z, C, nz, at, past, i, x - i, inflow)
            T0[u], p0[u] = T[u], p[u]
    return T0, p0


@ti.func
def from_cell(Z: ti.template(), C: ti.template(), nz, at: ti.template(), past: ti.template(), i0, f, inflow):
    """Departure values for all rows from the cell behind column i0, at its fractions f."""
    T4, p4 = [V(inflow) for _ in range(4)], [V(0.0) for _ in range(4)]
    first = at.q - at.i
    for t in ti.static(range(4)):
        if i0 - 1 + t >= 0:
            q = first + ti.min(i0 - 1 + t, at.nx)
            T4[t], p4[t] = Z[past.warm, q * nz + past.node], C[q, past.press]
    w = cubic(f)
    T, p = V(0.0), V(0.0)
    for t in ti.static(range(4)):
        T += w[t] * T4[t]
        p += w[t] * p4[t]
    return within(T, T4[1], T4[2]), within(p, p4[1], p4[2])


@ti.func
def across(Z: ti.template(), C: ti.template(), nz, at: ti.template(), past: ti.template(), q, moved):
    """Change of temperature and pressure by flow along y in column q; moved = v dt/dy."""
    m = past.node
    before, behind = columns_around(at, q)
    T = along_y(at, Z[past.warm, q * nz + m], Z[past.warm, before * nz + m], Z[past.warm, behind * nz + m], moved)
    return T, along_y(at, C[q, past.press], C[before, past.press], C[behind, past.press], moved)


@ti.func
def along_y(at: ti.template(), here, before, behind, moved):
    """Change of a value by flow along y: quadratic, linear at an extreme; before, behind: values in the neighbouring blocks.

    Quadratic interpolation alone does not damp a sawtooth of rows in two steps of BDF2, however far the oil moves: the row
    beside the border stayed at 257 deg C between rows of 113 and 106, in oil that carries nothing and conducts slowly. So the
    second difference counts only up to the smaller of both first differences, as in slope limiters (van Leer 1977).
    """
    lower, upper = rows_around(at, here, before, behind)
    rise, fall = upper - here, here - lower
    most = maximum(minimum(rise, fall), 0.0) + maximum(minimum(-rise, -fall), 0.0)
    bend = minimum(maximum(rise - fall, -most), most)
    speed = maximum(moved, -moved)
    upstream = ti.select(moved > 0.0, lower, upper)
    return speed * (upstream - here - 0.5 * (1.0 - speed) * bend)


# Rows that the oil moves along y in the two steps of BDF2, at most. Where it is swifter, thick oil that flows out at the sides
# (in a slender contact 2 % of the columns above 0.01 p_H, with steps of one column), both of its places are nearer by the same
# factor. With only the older place held back waves from row to row grow, by up to 1.5 a step: to 900 deg C in oil that carries
# nothing (radii of 12.7 and 2.3 mm, 0.6 GPa, 1024 columns). Half of it changes that contact by 3e-5 of its film, by 1e-4 K
FARTHEST = 1.0


@ti.func
def origin(Z: ti.template(), C: ti.template(), nz, at: ti.template(), past: ti.template(), u, v, step: ti.template(), inflow):
    """Temperature and pressure of an earlier state at the departure point of a node with velocities u and v."""
    x = at.i + past.moved - u * (past.seconds * step.inv_x)
    T0, p0 = along_x(Z, C, nz, at, past, x, inflow)
    if at.ny > 0:
        rows = minimum(maximum(v * (step.back_2 * step.inv_y), -FARTHEST), FARTHEST)  # in both steps
        moved = rows * (past.seconds / step.back_2)
        # between the two columns next to the first row's origin: taken at i, the step would be of first order in x y
        i0 = ti.min(ti.max(int(ti.floor(x[0])), 0), at.nx - 1)
        f, q0 = minimum(maximum(maximum(x, 0.0) - i0, -1.0), 2.0), at.q - at.i + i0
        inside = minimum(maximum(1.0 + x, 0.0), 1.0)  # oil that comes in is the same in all rows
        T1, p1 = across(Z, C, nz, at, past, q0, moved)
        T2, p2 = across(Z, C, nz, at, past, q0 + 1, moved)
        T0, p0 = T0 + inside * ((1.0 - f) * T1 + f * T2), p0 + inside * ((1.0 - f) * p1 + f * p2)
    return T0, p0


@ti.kernel
def departures(S: ti.template(), Z: ti.template(), C: ti.template(), G: Table, nz: ti.i32, conditions: Flat, numbers: Flat,
               report: Table):
    """Compute temperature and pressure at the departure points one and two steps ago (BDF2 along the path): cubic along x,
    quadratic along y with a limited second difference; in tiles that are not skipped.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        if report[c, RESTS] > 0.0:
            continue
        s, first, last = tile(c, nx)
        scene, step = read(Conditions, conditions), read(HeatStep, numbers)
        for i in range(first, last):
            at = block_at(G, c, i)
            for n in range(nz):
                u, v = Z[U, at.q * nz + n], Z[VY, at.q * nz + n]
                past = EarlierState(warm=TN, node=n, press=PN, seconds=step.back, moved=step.moved)
                warm, press = origin(Z, C, nz, at, past, u, v, step, scene.inlet)
                if step.far != 0.0:
                    before = EarlierState(warm=TNN, node=n, press=PNN, seconds=step.back_2, moved=step.moved_2)
                    warm_2, press_2 = origin(Z, C, nz, at, before, u, v, step, scene.inlet)
                    warm, press = step.near * warm + step.far * warm_2, step.near * press + step.far * press_2
                Z[TS, at.q * nz + n] = warm
                Z[PS, at.q * nz + n] = S[P, at.k] * scene.p_H - press


@ti.kernel
def accept(S: ti.template(), Z: ti.template(), C: ti.template(), G: Table, nz: ti.i32, p_H: ti.f64):
    """Store the present state as that of the last step."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        for q in range(s * (nx + 1) + first, s * (nx + 1) + last):
            for n in range(nz):
                Z[TNN, q * nz + n], Z[TN, q * nz + n] = Z[TN, q * nz + n], Z[T, q * nz + n]
                Z[MSNN, q * nz + n], Z[MSN, q * nz + n] = Z[MSN, q * nz + n], Z[MS, q * nz + n]
            C[q, PNN], C[q, PN] = C[q, PN], S[P, off + q] * p_H
