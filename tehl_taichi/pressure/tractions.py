"""Shear tractions on both surfaces from the film (isothermal: one viscosity across it) and from solid contact."""

from tehl_taichi.engine.lanes import Flat, Table, V, W, cells, place, tile, tiles
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import read
from tehl_taichi.physics.boundary import boundary_stress
from tehl_taichi.pressure.conditions import Conditions
from tehl_taichi.pressure.fields import GAP, IE, TOUCH, H, P
from tehl_taichi.pressure.gradient import central_gradient

X_A, Y_A, X_B, Y_B = range(4)  # along x and y on body a, on body b
Stack = ti.types.ndarray(dtype=ti.f64, ndim=3)


@ti.func
def solid_friction(rheology: ti.template(), p, u_s):
    """Stress on body a where the surfaces touch, against its slip u_s = u_a - u_b."""
    towards = 1.0 if u_s < 0 else (-1.0 if u_s > 0 else 0.0)
    return towards * boundary_stress(rheology, p)


@ti.func
def shear(rheology: ti.template(), p, h, eta, touch, u_s):
    """Mean shear stress on body a: the film's (eta as the shear law leaves it), or friction where the surfaces touch."""
    film = ti.select(p > 0, -eta * u_s / h, V(0.0))
    return ti.select(touch > 0, solid_friction(rheology, p, u_s), film)


@ti.func
def on_bodies(S: ti.template(), G: ti.template(), at: ti.template(), rheology: ti.template(), scene: ti.template()):
    """Force per area (Pa) on body a along x, on both along y, and on body b along x.

    z points from a to b. Stress tau(z) = tau_m + (z - h/2) dp/dx with tau_m from the slip and the viscosity that the flow
    feels; body a feels tau(0), body b feels -tau(h). Touching nodes: mu_b p, at most the shear limit.
    """
    px, py = central_gradient(S, G, at)
    half = 0.5 * S[H, at.k] * scene.h * scene.p_H / scene.a
    eta = scene.eta0 / S[IE, at.k]
    mean = shear(rheology, S[P, at.k] * scene.p_H, S[GAP, at.k] * scene.h, eta, S[TOUCH, at.k], scene.u_s)
    return mean - half * px, -half * py, -mean - half * px


@ti.func
def store(out: ti.template(), at: ti.template(), a_x, a_y, b_x, b_y):
    """Those of a place into a Stack."""
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
            at = place(G, c, i)
            a_x, y, b_x = on_bodies(S, G, at, rheology, scene)
            store(out, at, a_x, y, b_x, y)
