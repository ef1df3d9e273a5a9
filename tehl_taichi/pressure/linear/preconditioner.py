"""Additive line multigrid: one parallel line solve on every second level, summed from coarse to fine.

Inside a Krylov method one undamped parallel sweep per level needs less time than alternating colours or V cycles (6 to 8
iterations per Newton step at any grid, load and contact). It must be rebuilt at every Newton step.
"""

import numpy as np

from tehl_taichi.engine import simd
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.pressure import fields, influence
from tehl_taichi.pressure.levels import HEAVY
from tehl_taichi.pressure.linear import line_solver

# Bounds between local and distributed columns in time steps: (cells, half-widths) of the storage of the film, for one row and
# for several (docs/decisions/18)
STORED_LINE = 30.0, 0.0
STORED = 0.0, 4.0
# and of steady starts: one row with 2 does not converge on 2048 columns
REST_LINE, REST = 0.5, 8.0


class AdditiveLines:
    """Preparation of the preconditioner M^-1.

    levels: :class:`tehl_taichi.pressure.levels.Levels` with the linearised problem; krylov: the Krylov solver that applies
    M^-1.
    """

    def __init__(self, levels, krylov):
        self.levels = levels
        self.near, self.inverse = (np.zeros((2 * len(levels.sizes), line_solver.NEAR), levels.linear) for _ in range(2))
        for symbols in krylov.symbols[1:]:
            l = symbols.shape.level
            self.near[2 * l : 2 * l + 2] = levels.near_kernel(l, line_solver.NEAR)
            self.inverse[2 * l : 2 * l + 2] = symbols.near(line_solver.NEAR)
        self.count = sum(levels.sizes[l][1] // simd.W + 1 for l in levels.lines)
        self.coarsest = Coarsest(levels, krylov) if levels.dense else None
        self._bind()

    def _bind(self):
        v, bounds = self.levels, (REST, *STORED) if self.levels.ny else (REST_LINE, *STORED_LINE)
        self._classify = v.launch(line_solver.classify, v.S, v.J, v.G, v.blocks, *bounds)
        self._build_lines = v.launch(line_solver.build_lines, v.J, v.G, v.blocks, self.count, self.near, self.inverse,
                                     work=HEAVY)

    def build(self, coarsest=True):
        """Factorise the lines of every level (after the linearisation); coarsest: also invert the coarsest level."""
        self._classify()
        self._build_lines()
        if self.coarsest and coarsest:
            self.coarsest.build()


class Coarsest:
    """The coarsest level as a dense matrix: its Jacobian with the full deflection, and its inverse."""

    def __init__(self, levels, krylov):
        self.krylov, self.l = krylov, len(levels.sizes) - 1
        nx, ny = levels.sizes[-1]
        j, i = (q.ravel() for q in np.mgrid[: ny + 1, : nx + 1])
        self.place = (j // simd.W * (nx + 1) + i) * simd.W + j % simd.W
        self.neighbours = self._neighbours(i, j, nx, ny)
        bent = influence.matrix(*levels.deflection_key(self.l))
        self.influence = np.stack([bent[q] for q in self.neighbours])
        self.rows = np.zeros((len(fields.STENCIL), i.size), levels.linear)
        self._export = bind(line_solver.export_rows, levels.J, levels.G, self.l, self.rows, True)

    def _neighbours(self, i, j, nx, ny):
        """Node numbers at i-2, i-1, i, i+1, j+1, j-1, moved inside the grid (outside the rows have no weight)."""
        steps = ((-2, 0), (-1, 0), (0, 0), (1, 0), (0, 1), (0, -1))
        return [np.clip(j + q, 0, ny) * (nx + 1) + np.clip(i + p, 0, nx) for p, q in steps]

    def build(self):
        """Invert the level for the Krylov solver. Raises numpy.linalg.LinAlgError for a singular matrix."""
        self._export()
        half, nodes = len(fields.STENCIL) // 2, np.arange(self.place.size)
        J = np.einsum("qn,qnm->nm", self.rows[half:], self.influence)
        for a, q in zip(self.rows[:half], self.neighbours):
            J[nodes, q] += a
        self.krylov.set_dense(np.linalg.inv(J), self.place)
