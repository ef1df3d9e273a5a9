"""Shear tractions on both surfaces from the film (isothermal: one viscosity across it) and from solid contact."""

from tehl_taichi.engine.elementary import maximum, minimum, within
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import read
from tehl_taichi.engine.simd import Flat, Table, V, W, block_at, cells, tile, tiles
from tehl_taichi.laws.rheology import LARGEST
from tehl_taichi.laws.sheared_flow import mean_stress, wall_limit
from tehl_taichi.laws.solid_friction import boundary_stress
from tehl_taichi.pressure.conditions import Conditions
from tehl_taichi.pressure.fields import GAP, IE, TOUCH, H, P
from tehl_taichi.pressure.gradient import central_gradient

X_A, Y_A, X_B, Y_B = range(4)  # along x and y on body a, on body b
SMALLEST = 1e-300
Stack = ti.types.ndarray(dtype=ti.f64, ndim=3)


@ti.func
def solid_friction(rheology: ti.template(), p, u_s):
    """Stress on body a at touching nodes, against its slip u_s = u_a - u_b."""
    return against(u_s) * boundary_stress(rheology, p)


@ti.func
def against(u_s):
    """Sign of the stress on body a with slip u_s."""
    return 1.0 if u_s < 0 else (-1.0 if u_s > 0 else 0.0)


@ti.func
def borne(mean, half, limit):
    """(mean wall stress, half the difference of both walls), no wall beyond the limit.

    The mean is reduced first, because the difference balances the pressure.
    """
    kept = within(half, -limit, limit)
    room = limit - ti.abs(kept)
    return within(mean, -room, room), kept


@ti.func
def shortened(x, y, limit):
    """The vector (x, y), shortened to the limit."""
    part = minimum(limit / maximum(ti.sqrt(x * x + y * y), SMALLEST), 1.0)
    return x * part, y * part


@ti.func
def walls(mean_x, half_x, mean_y, half_y, limit):
    """Force per area on body a along x and y, and on body b along x and y, from the stress in the middle of the film and half
    its differences between the walls.
    """
    m_x, x = borne(mean_x, half_x, limit)
    m_y, y = borne(mean_y, half_y, limit)
    a_x, a_y = shortened(m_x - x, m_y - y, limit)
    b_x, b_y = shortened(-m_x - x, -m_y - y, limit)
    return a_x, a_y, b_x, b_y


@ti.func
def on_bodies(S: ti.template(), G: ti.template(), at: ti.template(), rheology: ti.template(), scene: ti.template()):
    """Force per area (Pa) on body a along x and y, and on body b along x and y.

    z points from a to b. Stress tau(z) = tau_m + (z - h/2) dp/dx with tau_m of the flow; body a feels tau(0), body b -tau(h).
    Touching nodes: mu_b p, at most the shear limit, and nothing else.
    """
    px, py = central_gradient(S, G, at)
    p, solid = S[P, at.k] * scene.p_H, S[TOUCH, at.k] > 0
    half = ti.select(solid, V(0.0), 0.5 * S[H, at.k] * scene.h * scene.p_H / scene.a)
    newtonian = minimum(ti.abs(scene.u_s) * scene.eta0 / (S[IE, at.k] * S[GAP, at.k] * scene.h), LARGEST)
    film = against(scene.u_s) * mean_stress(rheology, ti.abs(half * px), newtonian, p)
    mean = ti.select(solid, solid_friction(rheology, p, scene.u_s), ti.select(p > 0, film, V(0.0)))
    return walls(mean, half * px, V(0.0), half * py, wall_limit(rheology, p))


@ti.func
def store(out: ti.template(), at: ti.template(), a_x, a_y, b_x, b_y):
    """Store the tractions at a node in a Stack."""
    for u in ti.static(range(W)):
        j = at.s * W + u
        if j <= at.ny:
            out[X_A, at.i, j], out[Y_A, at.i, j], out[X_B, at.i, j], out[Y_B, at.i, j] = a_x[u], a_y[u], b_x[u], b_y[u]


@ti.kernel
def tractions(S: ti.template(), G: Table, rheology: ti.template(), conditions: Flat, out: Stack):
    """out[X_A, Y_A, X_B, Y_B; i, j] = force per area (Pa) on body a along x, y and on body b along x, y."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        scene = read(Conditions, conditions)
        for i in range(first, last):
            at = block_at(G, c, i)
            store(out, at, *on_bodies(S, G, at, rheology, scene))
