"""Interface between Newton and the linear solve: `solve(rhs)` returns a correction.

Newton uses nothing else of this folder. An implementation is a class with this method, which
:class:`tehl_taichi.pressure.newton.PressureSolver` takes as `linear`: `multigrid_gmres` (processors), `cells` (graphics cards).
"""

from dataclasses import dataclass
from typing import Any, Protocol

from numpy.typing import NDArray


@dataclass(frozen=True)
class RightHandSide:
    """Right-hand side of the problem that the tables of a :class:`tehl_taichi.pressure.levels.Levels` hold on all levels.

    rows : (levels.n,) of type levels.linear
        Right-hand side of the scaled rows (row scale: ``fields.SCALE``), in the order of the table.
    outflow : (levels.n,) of type levels.linear
        Weight of each scaled row in the net outflow. The residual contains a multiple of the remaining outflow.
    load : float or None
        Right-hand side of the load equation, ``sum(fields.WEIGHT * correction of P) = load``. None: no such equation, H0 is
        fixed.
    tolerance : float
        Norm of the residual to reach, relative to the norm of the right-hand side.
    change : float
        Largest change of P since the previous solve; inf if that was another problem. After a small change factors may be kept.
    """

    rows: NDArray[Any]
    outflow: NDArray[Any]
    load: float | None
    tolerance: float
    change: float


@dataclass(frozen=True)
class Correction:
    """Solution of a linear solve.

    pressure : (levels.n,)
        Change of P at every node, in the order of the table.
    approach : float
        Change of H0.
    iterations : int
        Number of iterations.
    """

    pressure: NDArray[Any]
    approach: float
    iterations: int


class LinearSolver(Protocol):
    """Solves the linearised problem of one :class:`tehl_taichi.pressure.levels.Levels`."""

    def solve(self, rhs: RightHandSide) -> Correction:
        """Return the Correction that solves the rows, the load equation and the net outflow to ``rhs.tolerance``.

        It has a larger residual if the largest number of iterations does not suffice. Raises numpy.linalg.LinAlgError for a
        singular problem.
        """
        ...
