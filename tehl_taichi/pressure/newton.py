"""Semismooth Newton for pressure and rigid approach: film, cavitation and solid contact as one complementarity.

At every unknown node  phi = min(P, R/D, (H - H_floor)/K_00) = 0:  P > 0 and the Reynolds equation holds (R = 0), or the
film has ruptured (P = 0, R >= 0), or the surfaces touch (H = H_floor, R >= 0). One more equation, the load, fixes H0.
Converged = rms of phi plus the load error below the tolerance: a residual of the discrete equations, never a step size.
"""

import functools
from dataclasses import dataclass, replace

import numpy as np

from tehl_taichi.engine import runtime
from tehl_taichi.errors import SceneError
from tehl_taichi.pressure import balances, fields, reynolds
from tehl_taichi.pressure.equations import Equations
from tehl_taichi.pressure.inlet import Inlet
from tehl_taichi.pressure.linear import red_black
from tehl_taichi.pressure.linear.interface import RightHandSide
from tehl_taichi.pressure.linear.multigrid_gmres import MultigridGmres
from tehl_taichi.values.arrays import nearest_index

SHORTEST_STEP = 0.05  # of a Newton step; below it a step is taken as it is and the next linearisation decides
SMALL_CHANGE = 0.05  # in P/p_H: near the solution full steps are taken although the merit may rise for a moment
SMALL_MERIT = 1e-2
# Alternatives to the next seven: docs/decisions/18
RISES = 2  # in a time step: two states that full steps take into each other have no end
SAME_SLOPES = 3e-3  # change of a round up to which later rounds of the step keep the slopes of the laws
ROW_CAP = 1.0  # largest row scale in the Krylov norm: the diagonal is about 0.02 in the contact but 1e3 in the inlet
FORCING = 0.6  # accuracy of a linear solve as a share of the reduction that convergence still needs
# and of what a Newton step is likely to gain: its nonlinear rest is about NONLINEAR times the square of the merit; later in a
# solve, gains repeat themselves (Eisenstat & Walker 1996, choice 2). At most numerics.krylov_tolerance
NONLINEAR = 30.0
GAIN, GAIN_POWER = 0.9, 1.618
# A linear solve reduces the mass error more than the norm of the rows, by ten to fifty times; starts have no limit of rises
MASS_GAIN, MASS_GAIN_OF_STARTS = 15.0, 10.0
MOST_SHARED = 0.5  # of the load: oil beyond the border that carries more than the grid is a domain that is too short
SHARED = 1e-6  # of the load: smaller changes of what the oil beyond the border carries are none
FIRST_ROUND = 0.1  # of :meth:`PressureSolver.improve`


@dataclass
class SolveReport:
    """Result of a solve: residual reached, load and mass errors, Newton steps, Krylov iterations, converged."""

    residual: float
    load_error: float
    mass_error: float
    newton: int
    cycles: int
    converged: bool

    def after(self, others):
        """This report, with the work of earlier ones added."""
        newton, cycles = (sum(getattr(one, name) for one in (self, *others)) for name in ("newton", "cycles"))
        return replace(self, newton=newton, cycles=cycles)


def pressure_solver(levels, film, most_rises=np.inf, carries_load=True):
    """The :class:`PressureSolver` of this machine: with jobs that are rows, or cells. Raises SceneError for an order of lines
    that only rows have."""
    if runtime.by_cells():
        if levels.scene.numerics.sweep == red_black.SWEEP:
            raise SceneError(f"numerics.sweep = {red_black.SWEEP!r} needs TEHL_ARCH=cpu without TEHL_CELLS; allowed here: "
                             "jacobi")
        from tehl_taichi.pressure.cells.newton import CellNewton

        return CellNewton(levels, film, most_rises, carries_load)
    return PressureSolver(levels, film, most_rises, carries_load=carries_load)


def or_not_converged(solve):
    """Call solve(); return an unconverged SolveReport if its linearisation is singular (a state far from the solution)."""

    @functools.wraps(solve)
    def guarded(*args, **options):
        try:
            return solve(*args, **options)
        except np.linalg.LinAlgError:
            return SolveReport(np.nan, np.nan, np.nan, 0, 0, False)

    return guarded


class PressureSolver:
    """Solves one step of `film` on `levels` (see :class:`Levels`, :class:`Equations`).

    linear: class of its linear solver (:class:`tehl_taichi.pressure.linear.interface.LinearSolver`), made for `levels`;
    carries_load: H0 follows from the load; otherwise it is given.
    """

    def __init__(self, levels, film, most_rises=np.inf, linear=MultigridGmres, carries_load=True):
        self.levels, self.most_rises, self.carries_load = levels, most_rises, carries_load
        self.take(film)
        self.linear = linear(levels)
        self.inside = levels.inside.astype(levels.linear)
        # load that the grid carries, see :meth:`share_load`; whether it follows the film, with the border
        self.load, self.shares = levels.scales.load, False
        self.H0, self.kept, self.keeps = 0.0, False, False
        self.border = None  # Inlet whose border follows the film; None: it rests
        self._bind()

    def _bind(self):
        v = self.levels
        self.b, self.mass_row, self.step = (np.zeros(v.n, v.linear) for _ in range(3))
        self.partial, self.touching = np.zeros((v.fine, balances.SUMS)), np.zeros((v.fine, 1))
        self.old, self.part = np.zeros(v.n), np.ones(1)
        self._keep_pressure = v.launch(balances.save, v.S, v.G, fields.P, self.old)
        self._move_pressure = v.launch(balances.advance, v.S, v.G, self.old, self.step, self.part)
        self._sums = v.launch(balances.sums, v.S, v.G, nearest_index(v.X, 0.0), self.partial)
        self._choose_sets = v.launch(balances.choose_sets, v.S, v.J, v.G, ROW_CAP, self.b, self.mass_row, self.touching)

    @functools.cached_property
    def _contact(self):
        v = self.levels
        return v.launch(reynolds.contact_right, v.S, v.J, v.G, self.b)  # 15 ms to make, which few scenes need

    def take(self, film):
        """Use density and viscosity of this film from now on."""
        self.equations = Equations(self.levels, film)

    def share_load(self):
        """Set the load that the grid carries; the oil beyond its border carries the rest. Returns whether it changed."""
        before, whole = self.load, self.levels.scales.load
        self.load = whole - (min(Inlet(self.levels).load(), MOST_SHARED * whole) if self.carries_load else 0.0)
        return abs(self.load - before) > SHARED * whole

    def residual(self):
        """Compute H, laws and R of the state in the table."""
        self.equations.residual(self.H0)

    def measure(self):
        """Return the merit (rms of phi plus load error), and set load error and mass error; needs the diagonal.

        Mass error: net outflow of the full-film region plus its storage, relative to the Couette flux through X = 0.
        """
        self._sums()
        sums = self.partial.sum(axis=0)
        self.couette = sums[balances.COUETTE]
        self.load_error = sums[balances.LOAD] / self.load - 1 if self.carries_load else 0.0
        self.mass_error = abs(sums[balances.OUTFLOW] / self.couette)
        return float(np.sqrt(sums[balances.PHI2] / self.levels.unknowns)) + abs(self.load_error)

    @or_not_converged
    def solve(self, krylov_tolerance=None, tolerance=None, newton_max=None, enough=0.0):
        """Newton iteration from the pressure in the table and H0; leaves the solution there. Returns a SolveReport.

        At the residual `enough` it stops without convergence.
        """
        numerics = self.levels.scene.numerics
        tolerance = tolerance or numerics.tolerance
        merit, cycles = self._begin(self.kept), 0
        # at least one Newton step: the residual does not see pressure errors where eps is 0, a prediction adds them up
        last = newton_max or numerics.newton_max
        for newton in range(1, last + 1):
            step, used = self._direction(self._forcing(krylov_tolerance or numerics.krylov_tolerance, merit, tolerance))
            cycles += used
            merit = self._advance(step, merit, newton == 1, tolerance)
            converged = not self._follow() and self._converged(merit, tolerance)
            if newton == last or converged or merit < enough or not np.isfinite(merit):
                break
            self.equations.linearise(again=True)
            merit = self.measure()
        self.kept = converged and (self.kept or (self.keeps and self.change < SAME_SLOPES))
        return SolveReport(merit, self.load_error, self.mass_error, newton, cycles, converged)

    @or_not_converged
    def improve(self, keeps=False):
        """One Newton step from a good guess; a small one is not checked, because later steps check it. Returns a SolveReport.

        keeps: reuse expensive data that hardly change, see `RightHandSide.change`, here and in later solves.
        """
        numerics, merit = self.levels.scene.numerics, self._begin()
        step, cycles = self._direction(FIRST_ROUND)
        self.change = float(np.abs(step[:-1]).max())
        small = self.change < SMALL_CHANGE
        self.keeps, self.kept = keeps, keeps and small
        if small:
            self._move(self._keep(step), step, 1.0)
            self.levels.set_film(self.H0)
        else:
            merit = self._advance(step, merit, True, numerics.tolerance)
        return SolveReport(merit, self.load_error, self.mass_error, 1, cycles, False)

    def holds(self):
        """Whether the state in the table solves the present equations."""
        return self._converged(self._begin(), self.levels.scene.numerics.tolerance)

    def _begin(self, kept=False):
        """Linearise about the state in the table; kept: it is near that of the last linear solve. Returns its merit."""
        self.residual()
        self.equations.linearise(kept and self.change < SAME_SLOPES)
        self.before, self.kept, self.rises = None, kept, 0
        if not kept:
            self.change = np.inf
        return self.measure()

    def _follow(self):
        """Let the border follow the film, and the load that the grid carries. Returns whether the equations changed."""
        if self.border is None:
            return False
        moved = self.border.follow()
        if moved:
            self.residual()
        return self.shares and self.share_load() or moved

    def _forcing(self, krylov_tolerance, merit, tolerance):
        """Relative accuracy of the linear solve: the likely gain of the Newton step, but not much more than convergence
        needs.
        """
        gain = MASS_GAIN_OF_STARTS if np.isinf(self.most_rises) else MASS_GAIN
        mass = gain * self.levels.scene.numerics.mass_tolerance / max(self.mass_error, 1e-300)
        needed = FORCING * min(tolerance / max(merit, 1e-300), mass)
        likely = NONLINEAR * merit if self.before is None else GAIN * (merit / self.before) ** GAIN_POWER
        self.before = merit
        return min(max(min(likely, krylov_tolerance), needed), 0.5)

    def _converged(self, merit, tolerance):
        return bool(merit < tolerance and self.mass_error < self.levels.scene.numerics.mass_tolerance)

    def worst(self):
        """Column along x and row along y of the largest residual."""
        v = self.levels
        gap = (v.get(fields.H) - v.G[0, fields.FLOOR]) / v.G[0, fields.K0]
        phi = np.minimum(np.minimum(v.get(fields.P), v.get(fields.R) / v.get(fields.D)), gap) * v.get(fields.MASK)
        j, i = np.unravel_index(int(np.argmax(np.abs(phi))), phi.shape)
        return int(i), int(j)

    def _direction(self, krylov_tolerance):
        self._choose_sets()
        touching = bool(self.touching.sum() > 0)
        self.equations.linearise_coarse()
        self.equations.replace_rows(touching)
        if touching:
            self._contact()
        self._scale_mass(self.b)
        load = -self.load_error * self.load if self.carries_load else None
        found = self.linear.solve(RightHandSide(self.b, self.mass_row, load, krylov_tolerance, self.change))
        return self._step(found), found.iterations

    def _step(self, found):
        """The change of the pressure that a linear solve has found, and that of H0 behind it."""
        return np.append(found.pressure * self.inside, self.levels.linear.type(found.approach))

    def _scale_mass(self, b):
        """Scale the mass component like the sum of all rows, but at most to their norm.

        A larger one would end a solve as soon as the mass is balanced, with the pressure hardly changed.
        """
        self.mass_row *= np.sqrt(self.levels.unknowns) / self.couette
        defect = abs(float(self.mass_row @ b))
        if defect > 0:
            self.mass_row *= min(1.0, float(np.sqrt(b @ b)) / defect)

    def _advance(self, step, merit, first, tolerance):
        """Damped update: halve the step until the merit falls (or, most_rises times, change and merit are small). Returns the
        merit, with the row scales of the last linearisation.
        """
        old_H0, t = self._keep(step), 1.0
        largest = float(np.abs(step[:-1]).max())
        while True:
            self._move(old_H0, step, t)
            self.residual()
            new = self.measure()
            falls = new < (1 - 1e-4 * t) * merit or (first and new < 2 * merit)
            settled = t * largest < SMALL_CHANGE and new < SMALL_MERIT and self.rises < self.most_rises
            if falls or settled or new < tolerance or t < SHORTEST_STEP:
                self.change, self.rises = t * largest, self.rises + (new >= merit)
                return new
            t *= 0.5

    def _keep(self, step):
        """Store the pressure and the step from it. Returns H0."""
        self._keep_pressure()
        np.copyto(self.step, step[:-1])
        return self.H0

    def _move(self, old_H0, step, t):
        """Set pressure and H0 to the old ones plus t times the step, with no negative pressure."""
        self.part[0] = t
        self._move_pressure()
        self.H0 = old_H0 + t * float(step[-1])
