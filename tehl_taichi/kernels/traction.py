"""Shear tractions on both surfaces from the film (isothermal: one viscosity across it) and from solid contact."""

import taichi as ti

from tehl_taichi.kernels.fields import IE, TOUCH, H, P
from tehl_taichi.kernels.reynolds import Table, cells
from tehl_taichi.physics.rheology import shear_limit, shear_stress


@ti.func
def slope(S: ti.template(), k, step, low, high, width):
    """dP/dx at node k from the neighbours that exist (low, high: 1 or 0)."""
    return (S[P, k + step * high] - S[P, k - step * low]) / (width * (low + high))


@ti.kernel
def tractions(S: Table, G: Table, rheology: ti.template(), p_H: ti.f64, h_scale: ti.f64, a: ti.f64, eta0: ti.f64,
              u_s: ti.f64, dx: ti.f64, dy: ti.f64, out: Table):
    """out[0..3] = force per area (Pa) on body a along x, y and on body b along x, y.

    z points from a to b. Stress tau(z) = tau_m + (z - h/2) dp/dx with tau_m from the slip u_b - u_a = -u_s through the
    shear law; body a feels tau(0), body b feels -tau(h). Touching nodes: mu_b p, at most the shear limit.
    """
    nx, ny, off = cells(G, 0)
    n2 = nx + 1
    for j in range(ny + 1):
        for i in range(n2):
            k = off + j * n2 + i
            p = S[P, k] * p_H
            h = S[H, k] * h_scale
            mean = 0.0
            if S[TOUCH, k] == 1.0:
                friction = ti.min(rheology.mu_boundary * p, shear_limit(rheology, p))
                mean = -friction if u_s > 0 else (friction if u_s < 0 else 0.0)
            elif p > 0:
                mean = shear_stress(rheology, -eta0 / S[IE, k] * u_s / h, p)
            px = 0.5 * h * p_H / a * slope(S, k, 1, ti.min(i, 1), ti.min(nx - i, 1), dx)
            py = 0.0
            if ny > 0:
                py = 0.5 * h * p_H / a * slope(S, k, n2, ti.min(j, 1), ti.min(ny - j, 1), dy)
            if j == 0:
                py = 0.0
            out[0, k] = mean - px
            out[1, k] = -py
            out[2, k] = -mean - px
            out[3, k] = -py
