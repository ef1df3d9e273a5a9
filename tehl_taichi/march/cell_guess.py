"""The guess for the next step by jobs that are cells: the kernels of :mod:`tehl_taichi.march.extrapolation`, a column a job."""

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import Flat, L, LinearTable, Table, W, cells, repeated
from tehl_taichi.march import extrapolation
from tehl_taichi.march.extrapolation import MADE, NOTHING, nearby, with_feature
from tehl_taichi.pressure.cells import twins
from tehl_taichi.pressure.cells.kernels import lane_block
from tehl_taichi.pressure.fields import MASK, P


@ti.kernel
def extrapolate(F: ti.template(), G: Table, order: ti.template(), rows: Flat, ways: Table, weights: Table, edges: LinearTable,
                by_edge: ti.template(), alone: ti.template()):
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        at = lane_block(G, q)
        out = [L(F, 0.0) for _ in ti.static(range(2 * order))]
        for n in range(order + 1):
            row = int(rows[n])
            still, moving = F[row, at.q], with_feature(F, at, row, ways, edges, by_edge, n)
            for g in ti.static(range(order)):
                weight = ti.cast(weights[g, n], F.dtype)
                out[g] += weight * still
                out[order + g] += weight * moving
        for g in ti.static(range(2 * order)):
            F[MADE + g, at.q] = out[g]


@ti.kernel
def judge(S: ti.template(), F: ti.template(), G: Table, order: ti.template(), rows: Flat, edges: LinearTable,
          alone: ti.template()):
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        at, row = lane_block(G, q), int(rows[0])
        there = [ti.min(ti.max(at.i + t, 0), nx) - at.i for t in ti.static(range(-1, 2))]
        for g in range(2 * order):
            missed = L(F, 0.0)
            for t in ti.static(range(3)):
                miss = F[MADE + g, at.q + there[t]] - ti.cast(S[P, at.k + there[t]], F.dtype)
                missed += miss * miss
            F[MADE + 2 * order + g, at.q] = missed
        newest = repeated(ti.cast(S[P, at.k], F.dtype), at.s, ny)
        F[row, at.q] = newest
        if at.s == ny // W:
            edges[row, at.i] = newest[W - 1]


@ti.kernel
def trust(S: ti.template(), F: ti.template(), G: Table, order: ti.template(), count: Flat, alone: ti.template()):
    nx, ny, off = cells(G, 0)
    for q in range((ny // W + 1) * (nx + 1)):
        at, out, total = lane_block(G, q), L(F, 0.0), L(F, 0.0)
        for g in ti.static(range(2 * order)):
            if g % order < int(count[0]):
                weight = L(F, 1.0) / (nearby(F, at, MADE + 2 * order + g) + L(F, NOTHING))
                out += weight * F[MADE + g, at.q]
                total += weight
        guess = ti.cast(ti.max(out / total, 0.0), ti.f64)
        S[P, at.k] = repeated(ti.select(S[MASK, at.k] > 0.0, guess, S[P, at.k]), at.s, ny)  # the border keeps its own


def stand_in():
    """Let these kernels stand for those of rows."""
    twins.KNOWN.update({extrapolation.extrapolate: (extrapolate, ()), extrapolation.judge: (judge, (5,)),
                        extrapolation.trust: (trust, ())})
