"""FGMRES with additive line multigrid for graphics cards, behind the interface of a linear solver."""

import math

import numpy as np

from tehl_taichi.pressure.linear.cells.solver import CellKrylov
from tehl_taichi.pressure.linear.interface import Correction
from tehl_taichi.pressure.linear.multigrid_gmres import SAME_COARSEST
from tehl_taichi.pressure.linear.preconditioner import Coarsest


class CellGmres:
    """The :class:`tehl_taichi.pressure.linear.interface.LinearSolver` for graphics cards; levels: the Levels with the
    problem."""

    def __init__(self, levels):
        self.krylov = CellKrylov(levels)
        self.coarsest = Coarsest(levels, self.krylov) if levels.dense else None

    def solve(self, rhs):
        """See :class:`tehl_taichi.pressure.linear.interface.LinearSolver`."""
        self.krylov.build()
        if self.coarsest and rhs.change > SAME_COARSEST:
            self.coarsest.build()
        if math.isinf(rhs.change):  # kept for a whole time step
            self.krylov.lift()
        approach, iterations, _ = self.krylov.solve(rhs.rows, rhs.outflow, rhs.load, rhs.tolerance)
        out = self.krylov.out.to_numpy() if isinstance(rhs.rows, np.ndarray) else self.krylov.out
        return Correction(out, approach, iterations)
