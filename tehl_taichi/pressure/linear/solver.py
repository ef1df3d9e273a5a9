"""The linear solve of a Newton step as one kernel: its memory, and the loop of its workers."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tehl_taichi.engine import field_pool, runtime, simd, task_pool
from tehl_taichi.engine.fft import Passes, odd_radices
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import LinearFlat, Table
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.grids import coarsen, columns, solved_by
from tehl_taichi.pressure.linear import convolution, gmres, operations
from tehl_taichi.pressure.linear.gmres import SCALARS
from tehl_taichi.pressure.linear.schedule import DECISION, FIRST_JOB, JOBS, Program

# lane vectors that the iterations of one launch process (about 0.25 us each on one core): while a kernel runs, Python cannot
# handle Ctrl-C, and its other threads wait
PORTION = 500_000
SMALLEST = 80_000  # least entries of the fields D and Y: all grids up to 256x64, and their starts, share one compiled kernel

Numbers = ti.types.ndarray(dtype=ti.i32, ndim=2)


@dataclass(frozen=True)
class SolverFields:
    """Fields of the solve.

    J: tables (see :mod:`fields`). V: vectors (see :mod:`operations`). D: inverse of the coarsest level. Y, T: spectra, symbols
    and buffers, and twiddle factors of the convolutions. odd: radices of their transforms. colours: whether lines are solved in
    two colours.
    """

    J: Any
    V: Any
    D: Any
    Y: Any
    T: Any
    odd: tuple
    colours: bool

    @property
    def filled(self):
        """Tables that are filled from outside, see :func:`tehl_taichi.engine.simd.fill`."""
        return self.Y, self.T, self.V, self.D, self.J


@ti.kernel
def linear_solve(memory: ti.template(), G: Table, C: Numbers, Q: Passes, todo: Numbers, jobs: Numbers, N: Table,
                 partial: Table, sync: task_pool.Sync, most: ti.i32, right: LinearFlat, outflow: LinearFlat, out: LinearFlat,
                 alone: ti.template()):
    """Run all phases from the phase in `sync` on, by the number of workers in `sync`."""
    ti.loop_config(block_dim=1, serialize=alone)
    for w in range(ti.cast(sync[task_pool.COUNT], ti.i32)):
        ticket, stays = task_pool.take(sync), True
        while stays and task_pool.phase_of(ticket) != task_pool.NO_PHASE:
            n, j = task_pool.phase_of(ticket), task_pool.job_of(ticket)
            if j < todo[n, JOBS]:
                q = todo[n, FIRST_JOB] + j
                operations.work(memory, G, C, Q, N, partial, jobs[q, 0], jobs[q, 1], jobs[q, 2], w, most, right, outflow, out)
                if task_pool.last_one(sync, todo[n, JOBS]):
                    task_pool.publish(sync, ticket, gmres.decide(N, partial, todo, n, todo[n, DECISION], most))
            else:
                stays = task_pool.waited(sync, ticket)
            if stays:
                ticket = task_pool.take(sync)


class Krylov:
    """FGMRES for the linearised problem in the tables of `levels` (:class:`tehl_taichi.pressure.levels.Levels`).

    Attributes, each (levels.n,): `right`: scaled rows of the right-hand side; `outflow`: weights of the scaled rows in the net
    outflow; `out`: result. `symbols`: of its convolutions, deflection first.
    """

    USUAL = 80  # least number of iterations that the memory is made for, so that scenes with fewer share a compiled kernel

    def __init__(self, levels):
        self.levels, self.most = levels, levels.scene.numerics.krylov_max
        shapes = convolution.transform_sizes(levels.sizes, levels.lines)
        self.team = task_pool.Team(levels.fine)
        self.symbols = [convolution.deflection(shapes[0], levels), *(convolution.distribution(c, levels) for c in shapes[1:])]
        self.right, self.outflow, self.out = (np.zeros(levels.n, levels.linear) for _ in range(3))
        self.numbers = np.zeros((gmres.TRIANGLE + self.most, self.most + 16))
        self.numbers[SCALARS, gmres.PORTION] = max(1, PORTION // columns(levels.nx, levels.ny))
        self.program = Program(levels, shapes)
        self._allocate(convolution.Layout(shapes))
        self._bind()

    def _allocate(self, layout):
        v, (dense, largest) = self.levels, self._largest()
        self.layout = layout
        size = [max(dense_entries(v.sizes, v.dense), dense, SMALLEST), max(layout.y, largest.y, SMALLEST),
                max(layout.t, largest.t)]
        rows = operations.BASIS + 2 * max(self.most, self.USUAL) + 1 + operations.AT_ONCE
        V = field_pool.lease(self, rows, simd.W, v.most_columns, precision=v.precision, clean=False)
        kinds = zip((simd.W, convolution.GROUP, 2), size)
        fields_of = (field_pool.lease(self, 1, n, count, precision=v.precision, clean=False) for n, count in kinds)
        self.memory = SolverFields(v.J, V, *fields_of, odd_radices(layout.lengths, largest.lengths),
                             self.program.colours)
        filled, weights = self.memory.filled, v.vector(fields.WEIGHT).astype(v.linear).reshape(-1, simd.W)
        convolution.prepare(layout.table, self.symbols, filled, layout.lengths, v.linear)
        simd.fill(*simd.one_of(filled, V), operations.LOADING, 0, weights)
        simd.fill(*simd.one_of(filled, v.J), fields.SCALE, int(v.G[0, simd.OFF]), np.ones_like(weights))

    def _largest(self):
        """(entries of the inverse, Layout) of the finest grid of the scene. The smaller grids of a start use the same memory,
        so that they share its compiled kernel."""
        scene = self.levels.scene
        sizes = coarsen(scene.grid.nx, scene.rows)
        dense, lines = solved_by(sizes)
        layout = convolution.Layout(convolution.transform_sizes(sizes, lines))
        return dense_entries(sizes, dense), layout

    def _bind(self):
        v, p = self.levels, self.program
        self.dense = np.zeros((dense_entries(v.sizes, v.dense), simd.W), v.linear)
        self._fill_dense = bind(simd.fill, *simd.one_of(self.memory.filled, self.memory.D), 0, 0, self.dense)
        self.partial = np.zeros((v.fine, gmres.DOT_SUM + self.most + operations.AT_ONCE))
        self._launch = bind(linear_solve, self.memory, v.G, self.layout.table, self.layout.lengths.table(), p.phases, p.jobs,
                            self.numbers, self.partial, self.team.sync, self.most, self.right, self.outflow, self.out,
                            runtime.ensure()["threads"] == 1)

    def set_dense(self, inverse, place):
        """Set the inverse (nodes, nodes) of the coarsest level, whose node n has the number place[n] in the order of the
        table."""
        self.dense[:] = dense_rows(inverse, place, self.levels)
        self._fill_dense()

    def lift(self):
        """Compute and keep the preconditioner's answer to a change of H0, for the bordered system."""
        self._run(self.program.lift)

    def solve(self, load, mass, tolerance):
        """Solve into `out` for the right-hand side `right`, `load` (None: H0 is fixed) and `mass` (net outflow).

        tolerance: norm of the residual, relative to that of the right-hand side; it may not be reached within the largest
        number of iterations. Returns (change of H0, number of iterations, reduction of the norm).
        """
        self.numbers[SCALARS, [gmres.LOAD, gmres.MASS, gmres.TOLERANCE]] = load or 0.0, mass, tolerance
        self.numbers[SCALARS, gmres.FIXED] = load is None
        self._run(self.program.solve)
        count, beta, left, rise = self.numbers[SCALARS, [gmres.COUNT, gmres.BETA, gmres.LEFT, gmres.RISE]]
        return float(rise), int(count), float(left / beta) if beta > 0 else 0.0

    def apply(self, z, rise):
        """Scaled Jacobian rows (levels.n,) times the change z (levels.n,) of the pressure and `rise` of H0.

        The result is a buffer that the next call overwrites.
        """
        np.copyto(self.right, z)
        self.numbers[SCALARS, [gmres.COUNT, gmres.RISE]] = -1, rise
        self._run(self.program.apply)
        return self.out

    def _run(self, phase):
        """Launch the kernel from `phase` on, until no launch is to follow."""
        scalars = self.numbers[SCALARS]
        while phase >= 0:
            scalars[gmres.NEXT] = -1
            self.team.run(self._launch, phase)
            phase = int(scalars[gmres.NEXT])


def dense_entries(sizes, dense):
    """Number of lane vectors of the inverse of the coarsest level."""
    return sum(columns(*sizes[l]) ** 2 * simd.W for l in dense)


def dense_rows(inverse, place, levels):
    """Lane vectors (entries, W) of the inverse (nodes, nodes) of the coarsest level; place: as for :meth:`Krylov.set_dense`."""
    size = columns(*levels.sizes[-1]) * simd.W
    whole = np.zeros((size, size), levels.linear)
    whole[np.ix_(place, place)] = inverse
    # [column, lane, from] -> [column, from, lane]
    return whole.reshape(-1, simd.W, size).transpose(0, 2, 1).reshape(-1, simd.W)
