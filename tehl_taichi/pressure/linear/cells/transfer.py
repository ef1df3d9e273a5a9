"""Transfers between a level and the next coarser one, one column per job; weights:
:mod:`tehl_taichi.pressure.linear.transfer`."""

from tehl_taichi.engine.language import ti
from tehl_taichi.pressure.linear.cells.sizes import place
from tehl_taichi.pressure.linear.operations import COARSE_WEIGHT
from tehl_taichi.pressure.linear.transfer import add_where_wet, doubled, restrict_column, transfer_weights


@ti.func
def restrict(J: ti.template(), G: ti.template(), fine: ti.template(), coarse: ti.template()):
    """Set RES of the coarser level."""
    for q in range(coarse.columns):
        t, i = place(coarse, q)
        lower, centre, upper = transfer_weights(J, G, fine.number, t)
        restrict_column(J, coarse.first + q, fine.first + 2 * t * fine.n2 + 2 * i, fine.n2, t, lower, centre, upper)


@ti.func
def prolong(J: ti.template(), fine: ti.template(), coarse: ti.template()):
    """Add COR of the coarser level to COR of the finer one."""
    share = ti.cast(COARSE_WEIGHT, J.dtype)
    for t in range(fine.blocks * coarse.nx):
        s, i = t // coarse.nx, t % coarse.nx
        c, k, half = coarse.first + s // 2 * coarse.n2 + i, fine.first + s * fine.n2 + 2 * i, s % 2
        left, right = doubled(J, c, coarse.n2, half), doubled(J, c + 1, coarse.n2, half)
        add_where_wet(J, k, fine.own, share * left)
        add_where_wet(J, k + 1, fine.own, share * (ti.cast(0.5, J.dtype) * (left + right)))
