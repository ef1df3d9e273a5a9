"""The guess for the next step by jobs that are cells: the kernels of :mod:`tehl_taichi.march.extrapolation`, a column a job."""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import Flat, LinearTable, Table, W, cells
from tehl_taichi.march import extrapolation
from tehl_taichi.march.extrapolation import combine, compare, predict
from tehl_taichi.pressure.cells import twins
from tehl_taichi.pressure.cells.kernels import lane_block


@ti.kernel
def extrapolate(F: ti.template(), G: Table, order: ti.template(), rows: Flat, ways: Table, weights: Table, edges: LinearTable,
                by_edge: ti.template(), alone: ti.template()):
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        at = lane_block(G, q)
        predict(F, at, order, rows, ways, weights, edges, by_edge)


@ti.kernel
def judge(S: ti.template(), F: ti.template(), G: Table, order: ti.template(), rows: Flat, edges: LinearTable,
          alone: ti.template()):
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        at = lane_block(G, q)
        compare(S, F, at, order, int(rows[0]), edges)


@ti.kernel
def trust(S: ti.template(), F: ti.template(), G: Table, order: ti.template(), count: Flat, alone: ti.template()):
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        at = lane_block(G, q)
        combine(S, F, at, order, count)


def stand_in():
    """Let these kernels stand for those of rows."""
    twins.KNOWN.update({extrapolation.extrapolate: (extrapolate, ()), extrapolation.judge: (judge, (5,)),
                        extrapolation.trust: (trust, ())})
