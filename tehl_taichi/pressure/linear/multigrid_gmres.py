"""FGMRES with additive line multigrid, behind the interface of a linear solver."""

import math

import numpy as np

from tehl_taichi.pressure.linear.interface import Correction
from tehl_taichi.pressure.linear.preconditioner import AdditiveLines
from tehl_taichi.pressure.linear.solver import Krylov

SAME_COARSEST = 0.05  # change of P/p_H up to which the inverse of the coarsest level is kept


class MultigridGmres:
    """The :class:`tehl_taichi.pressure.linear.interface.LinearSolver` for processors; levels: the Levels with the problem."""

    def __init__(self, levels):
        self.krylov = Krylov(levels)
        self.preconditioner = AdditiveLines(levels, self.krylov)

    def solve(self, rhs):
        """See :class:`tehl_taichi.pressure.linear.interface.LinearSolver`."""
        self.preconditioner.build(coarsest=rhs.change > SAME_COARSEST)
        if math.isinf(rhs.change):  # kept for a whole time step
            self.krylov.lift()
        np.copyto(self.krylov.right, rhs.rows)
        np.copyto(self.krylov.outflow, rhs.outflow)
        approach, iterations, _ = self.krylov.solve(rhs.load, float(rhs.outflow @ rhs.rows), rhs.tolerance)
        return Correction(self.krylov.out, approach, iterations)
