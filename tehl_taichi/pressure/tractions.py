"""Shear tractions on both surfaces from the film (isothermal: one viscosity across it) and from solid contact."""

import taichi as ti

from tehl_taichi.engine.lanes import Table, V, W, cells
from tehl_taichi.physics.boundary import boundary_stress
from tehl_taichi.pressure.fields import GAP, IE, TOUCH, H, P
from tehl_taichi.pressure.gradient import central_gradient

Stack = ti.types.ndarray(dtype=ti.f64, ndim=3)


@ti.func
def shear(rheology: ti.template(), p, h, eta, touch, slip):
    """Mean shear stress on body a: the film's (eta as the shear law leaves it), or friction where the surfaces touch."""
    towards = 1.0 if slip > 0 else (-1.0 if slip < 0 else 0.0)
    friction = towards * boundary_stress(rheology, p)
    film = ti.select(p > 0, eta * slip / h, V(0.0))
    return ti.select(touch > 0, friction, film)


@ti.kernel
def tractions(S: ti.template(), G: Table, rheology: ti.template(), p_H: ti.f64, h_scale: ti.f64, a: ti.f64, eta0: ti.f64,
              slip: ti.f64, dx: ti.f64, dy: ti.f64, out: Stack):
    """out[0..3, j, i] = force per area (Pa) on body a along x, y and on body b along x, y.

    z points from a to b. Stress tau(z) = tau_m + (z - h/2) dp/dx with tau_m from the slip u_b - u_a and the viscosity that
    the flow feels; body a feels tau(0), body b feels -tau(h). Touching nodes: mu_b p, at most the shear limit.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            k = off + s * (nx + 1) + i
            px, py = central_gradient(S, k, i, nx, s, ny, nx + 1, dx, dy)
            half = 0.5 * S[H, k] * h_scale * p_H / a
            mean = shear(rheology, S[P, k] * p_H, S[GAP, k] * h_scale, eta0 / S[IE, k], S[TOUCH, k], slip)
            a_x, b_x, y = mean - half * px, -mean - half * px, -half * py
            for u in ti.static(range(W)):
                j = s * W + u
                if j <= ny:
                    out[0, j, i], out[1, j, i], out[2, j, i], out[3, j, i] = a_x[u], y[u], b_x[u], y[u]
