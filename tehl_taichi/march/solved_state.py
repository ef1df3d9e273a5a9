"""State of the solver after a step, for the entries of `march/outputs/`: each value is read from its table once."""

import functools
import time
from dataclasses import dataclass
from typing import Optional

from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march.steady import scalars
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.grids import load_weights
from tehl_taichi.pressure.newton import PressureSolver, SolveReport


@dataclass(frozen=True, eq=False)
class SolvedState:
    """An accepted state, dimensionless. report: of its solve; started: time.perf_counter() at the start of the step; heat: None
    without temperatures; rejected: attempts; dt: of the step, s; moved: X, the clock of the passage, in a (None: steady start).
    """

    solver: PressureSolver
    heat: Optional[FilmHeat]
    report: SolveReport
    started: float
    rejected: int = 0
    dt: float = 0.0
    moved: Optional[float] = None

    @property
    def scene(self):
        return self.solver.levels.scene

    @property
    def scales(self):
        """Hertz units (:class:`tehl_taichi.scene.scales.Scales`)."""
        return self.solver.levels.scales

    @property
    def displacements(self):
        """Displacements of surfaces a and b since X = 0, m."""
        X = self.scene.path[0] if self.moved is None else self.moved
        return tuple(surface.pace * X * self.scales.a for surface in self.scene.surfaces)

    @functools.cached_property
    def P(self):
        """Pressure (ny+1, nx+1)."""
        return self.solver.levels.get(fields.P)

    @functools.cached_property
    def H(self):
        """Film (ny+1, nx+1)."""
        return self.solver.levels.get(fields.H)

    @functools.cached_property
    def touch(self):
        """Mask (ny+1, nx+1): 1 where the surfaces touch."""
        return self.solver.levels.get(fields.TOUCH)

    @property
    def T(self):
        """Temperatures (nodes across the film, ny+1, nx+1) in deg C, from surface a to b."""
        return self.heat.T

    @functools.cached_property
    def weights(self):
        """Weights of the nodes in the load (ny+1, nx+1)."""
        return load_weights(self.solver.levels)

    @functools.cached_property
    def extremes(self):
        """Numbers h_c, h_min, p_max."""
        return scalars(self.solver.levels, self.P, self.H)

    @property
    def H0(self):
        """Rigid approach."""
        return self.solver.H0

    @property
    def load(self):
        """Load of the contact."""
        return self.solver.levels.scales.load

    @property
    def wall(self):
        """Elapsed time of the step, s."""
        return time.perf_counter() - self.started

    @functools.cached_property
    def stress(self):
        """Shear (4, ny+1, nx+1) in Pa on body a along x, y and on body b along x, y."""
        return (self.heat or self.solver.equations.film).tractions()
