"""The film under the pressure in the table: its deflection, in double precision, as one kernel of workers.

Three phases: blocks of the pressure along x to waves, groups of waves along y, and back into the film.
"""

import numpy as np

from tehl_taichi.engine import lanes, runtime, tables, workers
from tehl_taichi.engine.fft import Passes
from tehl_taichi.engine.lanes import Flat, L, Table, V, W, cells
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.launches import bind
from tehl_taichi.pressure import convolution
from tehl_taichi.pressure.convolution import GROUPS, M, along_x, along_y, rows_of_worker
from tehl_taichi.pressure.fields import GAP0, H, P

SMALLEST = 10_000  # entries of the fields: all grids up to 256x64 share one compiled kernel
THERE, ACROSS, BACK = range(3)  # phases
Numbers = ti.types.ndarray(dtype=ti.i32, ndim=2)


@ti.func
def take_pressure(S: ti.template(), X: ti.template(), G: ti.template(), C: ti.template(), s, w):
    """The pressure of block s to the rows of worker w."""
    nx, ny, off = cells(G, 0)
    first, a = off + s * (nx + 1), rows_of_worker(C, w)
    for i in range(nx + 1):
        X[0, a + i] = S[P, first + i]
    for i in range(nx + 1, 2 * C[0, M]):
        X[0, a + i] = L(X, 0.0)


@ti.func
def give_film(S: ti.template(), X: ti.template(), G: ti.template(), s, x, H0):
    """H of block s from the deflection in the rows at x; ghosts are not deflected."""
    nx, ny, off = cells(G, 0)
    first, there = off + s * (nx + 1), V(0.0)
    for u in ti.static(range(W)):
        there[u] = 1.0 if s * W + u <= ny else 0.0
    for i in range(nx + 1):
        S[H, first + i] = S[GAP0, first + i] + (there * X[0, x + i] + H0)


@ti.func
def work(S: ti.template(), X: ti.template(), Y: ti.template(), T: ti.template(), G: ti.template(), C: ti.template(),
         Q: ti.template(), phase, j, w, H0):
    """Job j of a phase, by worker w."""
    if phase == ACROSS:
        along_y(Y, T, Q, C, 0, j, w)
    else:
        if phase == THERE:
            take_pressure(S, X, G, C, j, w)
        x = along_x(X, Y, T, Q, C, 0, j, w, phase // BACK)
        if phase == BACK:
            give_film(S, X, G, j, x, H0)


@ti.kernel
def bend(S: ti.template(), X: ti.template(), Y: ti.template(), T: ti.template(), G: Table, C: Numbers, Q: Passes, H0: Flat,
         sync: workers.Sync, alone: ti.template()):
    """H = undeformed gap + deflection by P + H0[0] of the finest level."""
    ti.loop_config(block_dim=1, serialize=alone)
    for w in range(ti.cast(sync[workers.COUNT], ti.i32)):
        ticket, stays = workers.take(sync), True
        while stays and workers.phase_of(ticket) != workers.NO_PHASE:
            phase, j = workers.phase_of(ticket), workers.job_of(ticket)
            jobs = C[0, GROUPS] if phase == ACROSS else cells(G, 0)[1] // W + 1
            if j < jobs:
                work(S, X, Y, T, G, C, Q, phase, j, w, H0[0])
                if workers.last_one(sync, jobs):
                    workers.publish(sync, ticket, -1 if phase == BACK else phase + 1)
            else:
                stays = workers.waited(sync, ticket)
            if stays:
                ticket = workers.take(sync)


class Bending:
    """Sets the film of `levels` (see :class:`Levels`)."""

    def __init__(self, levels):
        grid, self.H0, self.team = levels.scene.grid, np.zeros(1), workers.Team(levels.fine)
        shape, layout = self._layout(levels.nx, levels.ny)
        largest = self._layout(grid.nx, levels.scene.rows)[1]  # smaller grids of a start use its memory, and its kernel
        sizes = max(layout.x, largest.x, SMALLEST), max(layout.y, largest.y, SMALLEST), max(layout.t, largest.t)
        X, Y, T = (tables.lease(self, 1, n, size) for n, size in zip((lanes.W, convolution.GROUP, 2), sizes))
        self.table, self.passes = layout.table, layout.lengths.table()
        convolution.prepare(self.table, [convolution.deflection(shape, levels)], Y, T, layout.lengths, np.dtype(float))
        self.launch = bind(bend, levels.S, X, Y, T, levels.G, self.table, self.passes, self.H0, self.team.sync,
                           runtime.ensure()["threads"] == 1)

    def _layout(self, nx, ny):
        shape = convolution.shapes([(nx, ny)], [])[0]
        return shape, convolution.Layout([shape], 0, self.team.size)

    def bend(self, H0):
        """H from the pressure in the table and the rigid approach H0."""
        self.H0[0] = H0
        self.team.run(self.launch)
