"""Additive line multigrid: one parallel line solve on every level, summed from coarse to fine.

Inside a Krylov method one undamped parallel sweep per level beats alternating colours and V cycles per transform
(measured: 6-8 iterations a Newton step at any grid, load and contact); it must be rebuilt at every Newton step.
"""

import numpy as np

from tehl_taichi.kernels import fields, lines, reynolds, transfer
from tehl_taichi.runtime import bind
from tehl_taichi.solvers.levels import DENSE_LIMIT
from tehl_taichi.solvers.transforms import Deflection, Distribution

COARSE_WEIGHT = 0.8  # of the coarser levels' sum: 30.1 Krylov iterations a step with 0.5, 22.9 with 0.8, 24.3 with 1 (256x64)
THETA = 1.0  # switch between the two kinds of columns; flat from 0.3 to 3


class AdditiveLines:
    """z = M^-1 r for the linearised problem in the level table (see :class:`Levels`)."""

    def __init__(self, levels):
        self.levels = levels
        self.dense = levels.nodes(-1) <= DENSE_LIMIT
        smoothed = levels.sizes[:-1] if self.dense and len(levels.sizes) > 1 else levels.sizes
        self.dense = len(smoothed) < len(levels.sizes)
        self.count = sum(ny + 1 for _, ny in smoothed)
        self.distribution = Distribution(smoothed, levels.dx, levels.dy, levels.kind)
        levels.G[: len(smoothed), [fields.SPREAD, fields.PERIOD]] = self.distribution.places
        self.inverse = self.distribution.near()
        self.near = np.vstack([levels.near_kernel(l) for l in range(len(smoothed))])
        self.bands = np.zeros((levels.S.shape[1], 2 * lines.HALF + 1))
        if self.dense:
            self._prepare_dense(len(smoothed))
        self._bind()

    def _prepare_dense(self, l):
        v = self.levels
        nx, ny = v.sizes[l]
        n = v.nodes(-1)
        deflect = Deflection(nx, ny, v.dx * 2**l, v.dy * 2**l, v.kind)
        self.unit, self.unit_film, self.jacobian = np.eye(n), np.zeros((n, n)), np.zeros((n, n))
        film = np.zeros((1, n))
        for q in range(n):
            deflect.bound(self.unit, q, film)()
            self.unit_film[q] = film[0]

    def _bind(self):
        v, d = self.levels, self.distribution
        table = (v.S, v.G, v.rows, self.count)
        self.classify = bind(lines.classify, *table, THETA)
        self.build_lines = bind(lines.build_lines, *table, self.bands, self.near, self.inverse)
        self.solve_lines = bind(lines.solve_lines, *table, self.bands, d.source)
        self.collect_lines = bind(lines.collect_lines, *table, d.result)
        if len(v.sizes) > 1:
            self.prolong = bind(transfer.prolong, v.S, v.G, len(v.sizes), COARSE_WEIGHT)
        if self.dense:
            self.coarse_jacobian = bind(reynolds.jacobian, v.S, v.G, len(v.sizes) - 1, self.unit, self.unit_film,
                                        self.jacobian, len(self.unit))

    def build(self):
        """Linearise the coarser levels about the injected state and factorise every level."""
        self.levels.linearise_coarse()
        self.classify()
        self.build_lines()
        if self.dense:
            self.coarse_jacobian()
            self.coarse_inverse = np.linalg.inv(self.jacobian.T)

    def apply(self, r):
        """Correction of the finest level for the unscaled right-hand side r (n,); a copy."""
        v = self.levels
        v.flat(fields.RES)[:] = r
        v.restrict()
        self.solve_lines()
        self.distribution.run()
        self.collect_lines()
        if self.dense:
            self._solve_coarsest()
        if len(v.sizes) > 1:
            self.prolong()
        return v.flat(fields.COR).copy()

    def _solve_coarsest(self):
        v = self.levels
        off = int(v.G[-1, fields.OFF])
        nodes = slice(off, off + v.nodes(-1))
        v.S[fields.COR, nodes] = self.coarse_inverse @ v.S[fields.RES, nodes]
