"""Film for the pressure in the table: elastic deflection in double precision, as one kernel of workers.

Three phases: transforms along x of pairs of pressure blocks, transforms along y of groups of waves, and back to the film.
"""

import numpy as np

from tehl_taichi.engine import field_pool, runtime, task_pool
from tehl_taichi.engine.fft import Passes, odd_radices
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import Flat, Table, V, W, cells
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.pressure.fields import GAP0, H, P
from tehl_taichi.pressure.linear import convolution
from tehl_taichi.pressure.linear.convolution import (
    ACROSS,
    BACK,
    ENDLESS,
    GROUP,
    GROUPS,
    HALF_FIRST,
    NY,
    PAIRS,
    THERE,
    M,
    buffer,
    clear,
    first_of,
    pair,
    second_of,
    side_by_side,
    transformed,
)

SMALLEST = 10_000  # entries of the fields: all grids up to 256x64 share one compiled kernel
Numbers = ti.types.ndarray(dtype=ti.i32, ndim=2)


@ti.func
def bends(C: ti.template(), first_row):
    """Factor (1 or 0) for the lanes of a block: 1 if their pressure deflects the bodies.

    It is 0 at the sides of a point contact, where the pressure is given and small, and which the transforms of a half domain
    would count twice.
    """
    out, last = V(1.0), C[0, NY]
    for u in ti.static(range(W)):
        side = first_row + u >= last or (first_row + u == 0 and C[0, HALF_FIRST] == 0)
        out[u] = 0.0 if C[0, ENDLESS] == 0 and side else 1.0
    return out


@ti.func
def take_pressure(S: ti.template(), Y: ti.template(), G: ti.template(), C: ti.template(), j, w):
    """Copy the pressure of pair j to the rows of worker w."""
    first, second, n2 = pair(G, 0, j)
    a, block = buffer(C, w), ti.min(2 * j + 1, C[0, NY] // W)
    one, other = bends(C, 2 * j * W), bends(C, block * W)
    for i in range(n2):
        Y[0, a + i] = side_by_side(one * S[P, first + i], other * S[P, second + i])
    clear(Y, a + n2, a + 2 * C[0, M])


@ti.func
def bent(S: ti.template(), k, first_row, ny, change, H0):
    """Film H of the block of `first_row` in column k from its deflection; ghosts are not deflected."""
    there = V(0.0)
    for u in ti.static(range(W)):
        there[u] = 1.0 if first_row + u <= ny else 0.0
    S[H, k] = S[GAP0, k] + (there * change + H0)


@ti.func
def give_film(S: ti.template(), Y: ti.template(), G: ti.template(), j, x, H0):
    """Write the film H of pair j from the deflection in the rows at x."""
    first, second, n2 = pair(G, 0, j)
    ny = cells(G, 0)[1]
    for i in range(n2):
        change = Y[0, x + i]
        bent(S, second + i, (2 * j + 1) * W, ny, second_of(change), H0)
        bent(S, first + i, 2 * j * W, ny, first_of(change), H0)


@ti.func
def work(S: ti.template(), Y: ti.template(), T: ti.template(), G: ti.template(), C: ti.template(), Q: ti.template(),
         odd: ti.template(), phase, j, w, H0):
    """Do job j of a phase, as worker w."""
    if phase == THERE:
        take_pressure(S, Y, G, C, j, w)
    x = transformed(Y, T, Q, odd, C, 0, j, w, phase)
    if phase == BACK:
        give_film(S, Y, G, j, x, H0)


@ti.kernel
def bend(S: ti.template(), Y: ti.template(), T: ti.template(), G: Table, C: Numbers, Q: Passes, odd: ti.template(), H0: Flat,
         sync: task_pool.Sync, alone: ti.template()):
    """Compute H = undeformed gap + deflection by P + H0[0] on the finest level."""
    ti.loop_config(block_dim=1, serialize=alone)
    for w in range(ti.cast(sync[task_pool.COUNT], ti.i32)):
        ticket, stays = task_pool.take(sync), True
        while stays and task_pool.phase_of(ticket) != task_pool.NO_PHASE:
            phase, j = task_pool.phase_of(ticket), task_pool.job_of(ticket)
            jobs = C[0, GROUPS] if phase == ACROSS else C[0, PAIRS]
            if j < jobs:
                work(S, Y, T, G, C, Q, odd, phase, j, w, H0[0])
                if task_pool.last_one(sync, jobs):
                    task_pool.publish(sync, ticket, -1 if phase == BACK else phase + 1)
            else:
                stays = task_pool.waited(sync, ticket)
            if stays:
                ticket = task_pool.take(sync)


class Bending:
    """Computes the film of `levels` (see :class:`Levels`)."""

    def __init__(self, levels):
        grid, self.H0, self.team = levels.scene.grid, np.zeros(1), task_pool.Team(levels.fine)
        shape, layout = self._layout(levels.nx, levels.ny)
        largest = self._layout(grid.nx, levels.scene.rows)[1]  # smaller grids of a start use its memory, and its kernel
        sizes = max(layout.y, largest.y, SMALLEST), max(layout.t, largest.t)
        Y, T = (field_pool.lease(self, 1, n, size, clean=False) for n, size in zip((GROUP, 2), sizes))
        self.table, self.passes = layout.table, layout.lengths.table()
        convolution.prepare(self.table, [convolution.deflection(shape, levels)], (Y, T), layout.lengths, np.dtype(float))
        odd = odd_radices(layout.lengths, largest.lengths)
        self.launch = bind(bend, levels.S, Y, T, levels.G, self.table, self.passes, odd, self.H0, self.team.sync,
                           runtime.ensure()["threads"] == 1)

    @staticmethod
    def _layout(nx, ny):
        shape = convolution.transform_sizes([(nx, ny)], [])[0]
        return shape, convolution.Layout([shape])

    def bend(self, H0):
        """Compute H from the pressure in the table and the rigid approach H0."""
        self.H0[0] = H0
        self.team.run(self.launch)


def bending(levels):
    """What sets the film of `levels`."""
    if runtime.by_cells():
        from tehl_taichi.pressure.cells.bending import CellBending

        return CellBending(levels)
    return Bending(levels)
