"""Density, viscosity and mobility of a film that has one temperature."""

import taichi as ti

from tehl_taichi.kernels.fields import DLE, DRP, FLOOR, GAP, IE, ILAM, LE, QP, RHO, ROOT, H, P
from tehl_taichi.kernels.lanes import Table, W, cells
from tehl_taichi.physics.density import rho_ratio
from tehl_taichi.physics.elementary import exp
from tehl_taichi.physics.viscosity import ln_eta

DP = 1e3  # Pa, step of the difference quotients of the laws: their scale is 1e8 Pa, so the quotient is good to 1e-5


@ti.func
def node_laws(S: ti.template(), k, oil: ti.template(), p_H, Gamma, ln_eta0, inv_lambda, floor):
    p = S[P, k] * p_H
    rho = rho_ratio(oil, p, Gamma)
    le = ln_eta(oil, p, Gamma) - ln_eta0
    S[RHO, k] = rho
    S[LE, k] = le
    S[IE, k] = exp(-le)
    S[ROOT, k] = ti.sqrt(rho * inv_lambda)
    S[GAP, k] = ti.max(S[H, k], floor)


@ti.func
def node_slopes(S: ti.template(), k, oil: ti.template(), p_H, Gamma, ln_eta0):
    p = S[P, k] * p_H + DP
    drho = (rho_ratio(oil, p, Gamma) - S[RHO, k]) * (p_H / DP)
    S[DLE, k] = (ln_eta(oil, p, Gamma) - ln_eta0 - S[LE, k]) * (p_H / DP)
    S[QP, k] = drho * S[H, k]
    S[DRP, k] = 0.5 * S[ROOT, k] * drho / S[RHO, k]


@ti.kernel
def laws(S: ti.template(), G: Table, oil: ti.template(), p_H: ti.f64, Gamma: ti.f64, ln_eta0: ti.f64, slopes: ti.template(),
         alone: ti.template()):
    """Density, viscosity and mobility on the finest level; with slopes = 1 their derivatives, which need the values."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        floor = G[0, FLOOR]
        for k in range(off + s * (nx + 1), off + (s + 1) * (nx + 1)):
            if ti.static(slopes):
                node_slopes(S, k, oil, p_H, Gamma, ln_eta0)
            else:
                node_laws(S, k, oil, p_H, Gamma, ln_eta0, G[0, ILAM], floor)
