"""Density, viscosity and mobility of an isothermal film.

Without the shear law: its effect on the flow is computed at the faces (:mod:`tehl_taichi.pressure.fluxes`).
"""

from tehl_taichi.engine.elementary import exp, maximum
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import read
from tehl_taichi.engine.simd import Flat, Table, V, W, cells
from tehl_taichi.laws.density import rho_ratio
from tehl_taichi.laws.rheology import DP
from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.pressure.conditions import Conditions
from tehl_taichi.pressure.fields import DLE, DRP, FLOOR, GAP, IE, ILAM, LE, QP, RHO, ROOT, H, P


@ti.func
def store_laws(S: ti.template(), k, h, rho, le, ie, inv_lambda):
    S[RHO, k], S[LE, k], S[IE, k] = rho, le, ie
    S[ROOT, k], S[GAP, k] = ti.sqrt(rho * inv_lambda), h


@ti.func
def store_slopes(S: ti.template(), k, rho, le, rate):
    """Store derivatives by P at fixed H, from the values at P + DP; rate: 1/DP, times p_H."""
    S[DLE, k] = (le - S[LE, k]) * rate
    S[QP, k] = (rho - S[RHO, k]) * rate * S[H, k]
    S[DRP, k] = 0.5 * S[ROOT, k] * (rho / S[RHO, k] - 1.0) * rate


@ti.kernel
def laws(S: ti.template(), G: Table, oil: ti.template(), conditions: Flat, rows: ti.template(), slopes: ti.template(),
         alone: ti.template()):
    """Compute density, viscosity and mobility on the finest level; with slopes = 1 their derivatives, which need the values.
    rows: the LawRows that the equations read.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        floor, scene = G[0, FLOOR], read(Conditions, conditions)
        for k in range(off + s * (nx + 1), off + (s + 1) * (nx + 1)):
            p, h = S[P, k] * scene.p_H + slopes * DP, maximum(S[H, k], floor)
            rho, le = rho_ratio(oil, p, scene.inlet), ln_eta(oil, p, scene.inlet) - scene.ln_eta0
            ie = exp(-le)
            if ti.static(slopes):
                store_slopes(S, k, rho, le, scene.p_H / DP)
                if ti.static(rows.slope != QP):
                    S[rows.slope, k], S[rows.skew + 1, k] = S[QP, k], V(0.0)
            else:
                store_laws(S, k, h, rho, le, ie, G[0, ILAM])
                if ti.static(rows.couette != RHO):
                    S[rows.couette, k], S[rows.skew, k] = rho, V(1.0)
