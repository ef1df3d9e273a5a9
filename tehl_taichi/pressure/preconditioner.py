"""Additive line multigrid: one parallel line solve on every second level, summed from coarse to fine.

Inside a Krylov method one undamped parallel sweep per level beats alternating colours and V cycles per transform
(measured: 6-8 iterations a Newton step at any grid, load and contact); it must be rebuilt at every Newton step.
"""

import functools

import numpy as np

from tehl_taichi.engine import lanes
from tehl_taichi.engine.launches import bind
from tehl_taichi.pressure import fields, lines, transfer
from tehl_taichi.pressure.deflection import Deflection, Distribution
from tehl_taichi.pressure.levels import HEAVY

COARSE_WEIGHT = 0.8  # of the coarser levels' sum: 30.1 Krylov iterations a step with 0.5, 22.9 with 0.8, 24.3 with 1 (256x64)
THETA = 1.0  # switch between the two kinds of columns; flat from 0.3 to 3


class AdditiveLines:
    """z = M^-1 r for the linearised problem in the level table (see :class:`Levels`)."""

    def __init__(self, levels):
        self.levels = levels
        self.distribution = Distribution([levels.grid(l) for l in levels.lines], levels.scales.compliance, levels.linear)
        self.near, self.inverse = (np.zeros((2 * len(levels.sizes), lines.NEAR), levels.linear) for _ in range(2))
        inverse = self.distribution.near(lines.NEAR)
        for n, (l, place) in enumerate(zip(levels.lines, self.distribution.places)):
            levels.numbers.set_rows(l, *place)
            self.near[2 * l : 2 * l + 2] = levels.near_kernel(l, lines.NEAR)
            self.inverse[2 * l : 2 * l + 2] = inverse[2 * n : 2 * n + 2]
        self.count = sum(levels.sizes[l][1] // lanes.W + 1 for l in levels.lines)
        self.coarsest = Coarsest(levels) if levels.dense else None
        self.r, self.z = (np.zeros(levels.n, levels.linear) for _ in range(2))
        self._bind()

    def _bind(self):
        v, d, size = self.levels, self.distribution, len(self.levels.sizes)
        coarse = self.coarsest or Coarsest(v, dense=False)
        self._classify = [v.launch(lines.classify, v.S, v.J, v.G, v.blocks, *cut, touching, THETA) for touching in (0, 1)
                          for cut in ((0, v.fine), (v.fine, len(v.blocks)))]
        self._build_lines = v.launch(lines.build_lines, v.J, v.G, v.blocks, self.count, self.near, self.inverse, work=HEAVY)
        self._descend = v.launch(transfer.descend, v.J, v.G, size, self.r, coarse.right)
        self._solve_lines = v.launch(lines.solve_lines, v.J, v.G, v.blocks, self.count, d.source)
        self._ascend = v.launch(transfer.ascend, v.J, v.G, v.blocks, self.count, size, d.result, coarse.solution,
                                COARSE_WEIGHT, self.z)

    def build(self, touching, anew=True):
        """Factorise every level, which must be linearised; with anew = False the coarsest one stays what it was, for small
        changes."""
        fine, coarse = self._classify[2:] if touching else self._classify[:2]
        fine()
        coarse()
        self._build_lines()
        if self.coarsest and anew:
            self.coarsest.build()

    def apply(self, r):
        """Correction (n,) of the finest level for the right-hand side r (n,) of the scaled rows; a buffer."""
        np.copyto(self.r, r)
        self._descend()
        self._solve_lines()
        self.distribution.distribute()
        if self.coarsest:
            self.coarsest.solve()
        self._ascend()
        return self.z


class Coarsest:
    """The coarsest level as a dense matrix: its Jacobian with the full deflection, inverted at every Newton step."""

    def __init__(self, levels, dense=True):
        self.levels, self.l = levels, len(levels.sizes) - 1
        nx, ny = levels.sizes[-1]
        size = (ny // lanes.W + 1) * (nx + 1) * lanes.W
        self.right, self.solution = (np.zeros(size, levels.linear) for _ in range(2))
        j, i = (q.ravel() for q in np.mgrid[: ny + 1, : nx + 1])
        self.place = (j // lanes.W * (nx + 1) + i) * lanes.W + j % lanes.W
        if dense:
            self.neighbours = self._neighbours(i, j, nx, ny)
            influence = dense_deflection(*levels.deflection_key(self.l))
            self.influence = np.stack([influence[q] for q in self.neighbours])
            self.rows = np.zeros((len(fields.STENCIL), i.size), levels.linear)
            self._export = bind(lines.export_rows, levels.J, levels.G, self.l, self.rows, True)

    def _neighbours(self, i, j, nx, ny):
        """Node numbers of i-2, i-1, i, i+1, j+1, j-1; those outside have no weight."""
        steps = ((-2, 0), (-1, 0), (0, 0), (1, 0), (0, 1), (0, -1))
        return [np.clip(j + q, 0, ny) * (nx + 1) + np.clip(i + p, 0, nx) for p, q in steps]

    def build(self):
        self._export()
        half, nodes = len(fields.STENCIL) // 2, np.arange(self.place.size)
        J = np.einsum("qn,qnm->nm", self.rows[half:], self.influence)
        for a, q in zip(self.rows[:half], self.neighbours):
            J[nodes, q] += a
        self.inverse = np.linalg.inv(J).astype(self.levels.linear)

    def solve(self):
        self.solution[self.place] = self.inverse @ self.right[self.place]


@functools.lru_cache(maxsize=4)  # the grids of a steady start end in the same one
def dense_deflection(nx, ny, *rest):
    """Deflection of a small grid as a matrix (nodes, nodes); rest: see :meth:`Levels.deflection_key`."""
    deflect, n = Deflection(nx, ny, *rest), (nx + 1) * (ny + 1)
    K, unit = np.zeros((n, n)), np.zeros((ny + 1, nx + 1))
    for node in range(n):
        if node % (nx + 1):  # the first column has no pressure
            unit.ravel()[node] = 1.0
            K[:, node] = deflect.apply(unit).ravel()
            unit.ravel()[node] = 0.0
    return K
