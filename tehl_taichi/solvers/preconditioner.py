"""Additive line multigrid: one parallel line solve on every level, summed from coarse to fine.

Inside a Krylov method one undamped parallel sweep per level beats alternating colours and V cycles per transform
(measured: 6-8 iterations a Newton step at any grid, load and contact); it must be rebuilt at every Newton step.
"""

import numpy as np

from tehl_taichi.kernels import fields, lines, reynolds, transfer
from tehl_taichi.solvers.levels import DENSE_LIMIT
from tehl_taichi.solvers.transforms import Deflection, Distribution

COARSE_WEIGHT = 0.5  # of the coarser levels' sum: 1 over-corrects (15 instead of 13 iterations), 0.5 was the best
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

    def _prepare_dense(self, l):
        v = self.levels
        nx, ny = v.sizes[l]
        n = v.nodes(-1)
        deflect = Deflection(nx, ny, v.dx * 2**l, v.dy * 2**l, v.kind)
        self.unit, self.unit_film, self.jacobian = np.eye(n), np.zeros((n, n)), np.zeros((n, n))
        for q in range(n):
            deflect(self.unit, q, 0.0, self.unit_film[q : q + 1])

    def build(self):
        """Linearise the coarser levels about the injected state and factorise every level."""
        v = self.levels
        transfer.inject(v.S, v.G, len(v.sizes))
        v.linearise(v.ny + 1, len(v.rows))
        lines.classify(v.S, v.G, v.rows, self.count, THETA)
        lines.build_lines(v.S, v.G, v.rows, self.count, self.bands, self.near, self.inverse)
        if self.dense:
            last = len(v.sizes) - 1
            reynolds.jacobian(v.S, v.G, last, self.unit, self.unit_film, self.jacobian, self.unit.shape[0])
            self.coarse_inverse = np.linalg.inv(self.jacobian.T)

    def apply(self, r):
        """Correction of the finest level for the unscaled right-hand side r (n,); a copy."""
        v = self.levels
        v.flat(fields.RES)[:] = r
        if len(v.sizes) > 1:
            transfer.restrict(v.S, v.G, len(v.sizes))
        lines.solve_lines(v.S, v.G, v.rows, self.count, self.bands, self.distribution.source)
        self.distribution.run()
        lines.collect_lines(v.S, v.G, v.rows, self.count, self.distribution.result)
        if self.dense:
            self._solve_coarsest()
        if len(v.sizes) > 1:
            transfer.prolong(v.S, v.G, len(v.sizes), COARSE_WEIGHT)
        return v.flat(fields.COR).copy()

    def _solve_coarsest(self):
        v = self.levels
        off = int(v.G[-1, fields.OFF])
        nodes = slice(off, off + v.nodes(-1))
        v.S[fields.COR, nodes] = self.coarse_inverse @ v.S[fields.RES, nodes]
