"""The linear solve of a Newton step as Newton sees it: `solve(rhs)` returns a correction.

Newton knows nothing else of this folder. A second implementation (for graphics cards, say) is a class with this method, which
:class:`tehl_taichi.pressure.newton.PressureSolver` takes as `linear`.
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
        Weight of each scaled row in the net outflow. A multiple of the outflow that is left belongs to the residual.
    load : float or None
        Right-hand side of the load equation, ``sum(fields.WEIGHT * correction of P) = load``. None: there is none, H0 stays.
    tolerance : float
        Norm of the residual to reach, relative to the norm of the right-hand side.
    change : float
        Largest change of P since the previous solve, inf where that was another problem. Factors of a near problem may be kept.
    """

    rows: NDArray[Any]
    outflow: NDArray[Any]
    load: float | None
    tolerance: float
    change: float


@dataclass(frozen=True)
class Correction:
    """pressure: of P at every node, in the order of the table (levels.n,); approach: of H0; iterations: that it took."""

    pressure: NDArray[Any]
    approach: float
    iterations: int


class LinearSolver(Protocol):
    """Solves the linearised problem of one :class:`tehl_taichi.pressure.levels.Levels`."""

    def solve(self, rhs: RightHandSide) -> Correction:
        """Correction that solves the rows, the load equation and the net outflow to ``rhs.tolerance``, or as far as iterations
        go. Raises numpy.linalg.LinAlgError where the problem has no inverse."""
        ...
