"""Additive line multigrid: one parallel line solve on every level, summed from coarse to fine.

Inside a Krylov method one undamped parallel sweep per level beats alternating colours and V cycles per transform
(measured: 6-8 iterations a Newton step at any grid, load and contact); it must be rebuilt at every Newton step.
"""

import numpy as np

from tehl_taichi.kernels import fields, lines, reynolds, transfer
from tehl_taichi.solvers.levels import DENSE_LIMIT
from tehl_taichi.solvers.transforms import Deflection

COARSE_WEIGHT = 0.5  # of the coarser levels' sum: 1 over-corrects (15 instead of 13 iterations), 0.5 was the best
THETA = 1.0  # switch between the two kinds of columns; flat from 0.3 to 3


class AdditiveLines:
    """z = M^-1 r for the linearised problem in the level table (see :class:`Levels`)."""

    def __init__(self, levels):
        self.levels = levels
        last = len(levels.sizes) - 1
        self.dense = levels._nodes(-1) <= DENSE_LIMIT
        self.smoothed = range(last) if self.dense else range(last + 1)
        self.distribution = [levels.distribution(l) for l in self.smoothed]
        self.inverse = [np.ascontiguousarray(d.near()) for d in self.distribution]
        self.near = [np.ascontiguousarray(levels.near_kernel(l)) for l in self.smoothed]
        self.bands = np.zeros((levels.S.shape[1], 2 * lines.HALF + 1))
        if self.dense:
            self._prepare_dense(last)

    def _prepare_dense(self, l):
        v = self.levels
        nx, ny = v.sizes[l]
        n = v._nodes(l)
        deflect = Deflection(nx, ny, v.dx * 2**l, v.dy * 2**l, v.kind)
        self.unit, self.unit_film, self.jacobian = np.eye(n), np.zeros((n, n)), np.zeros((n, n))
        for q in range(n):
            deflect(self.unit, q, 0.0, self.unit_film[q : q + 1])

    def build(self):
        """Linearise the coarser levels about the injected state and factorise every level."""
        v = self.levels
        for l in range(1, len(v.sizes)):
            transfer.inject(v.S, v.G, l - 1)
            v.laws(l, slopes=True)
            reynolds.linearise(v.S, v.G, l)
        for l in self.smoothed:
            lines.build_lines(v.S, v.G, l, self.bands, self.near[l], self.inverse[l], THETA)
        if self.dense:
            last = len(v.sizes) - 1
            reynolds.jacobian(v.S, v.G, last, self.unit, self.unit_film, self.jacobian, self.unit.shape[0])
            self.coarse_inverse = np.linalg.inv(self.jacobian.T)

    def apply(self, r):
        """Correction of the finest level for the unscaled right-hand side r (n,); a copy."""
        v = self.levels
        v.S[fields.RES, : v.n] = r
        for l in self.smoothed:
            self._smooth(l)
            if l + 1 < len(v.sizes):
                transfer.restrict(v.S, v.G, l)
        if self.dense:
            self._solve_coarsest()
        for l in range(len(v.sizes) - 2, -1, -1):
            transfer.prolong(v.S, v.G, l, COARSE_WEIGHT)
        return v.S[fields.COR, : v.n].copy()

    def _smooth(self, l):
        v, d = self.levels, self.distribution[l]
        lines.solve_lines(v.S, v.G, l, self.bands, d.source)
        d.run()
        lines.collect_lines(v.S, v.G, l, d.result)

    def _solve_coarsest(self):
        v = self.levels
        off = int(v.G[-1, fields.OFF])
        nodes = slice(off, off + v._nodes(-1))
        v.S[fields.COR, nodes] = self.coarse_inverse @ v.S[fields.RES, nodes]
