"""Semismooth Newton for pressure and rigid approach: film, cavitation and solid contact as one complementarity.

At every unknown node  phi = min(P, R/D, (H - H_floor)/K_00) = 0:  P > 0 and the Reynolds equation holds (R = 0), or the
film has ruptured (P = 0, R >= 0), or the surfaces touch (H = H_floor, R >= 0). One more equation, the load, fixes H0.
Converged = rms of phi plus the load error below the tolerance: a residual of the discrete equations, never a step size.
"""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.kernels import deflection as gap_kernel
from tehl_taichi.kernels import fields, reynolds
from tehl_taichi.solvers.krylov import Workspace, fgmres
from tehl_taichi.solvers.preconditioner import AdditiveLines

SHORTEST_STEP = 0.05  # of a Newton step; below it a step is taken as it is and the next linearisation decides
SMALL_CHANGE = 0.05  # in P/p_H: near the solution full steps are taken although the merit may rise for a moment
SMALL_MERIT = 1e-2
# Largest row scale in the Krylov norm. The diagonal is about 0.02 in the contact but 1e3 in the inlet: scaled with it, a
# mass defect there is invisible. To a mass error of 1e-6 at 128x32: 6.2 Newton, 49 Krylov a step without the cap, 4.7/41
# with 1, 4.1/38 with 0.1, 3.7/34 with 0.03 (cap in the merit too: no convergence from Hertz).
ROW_CAP = 0.03


@dataclass
class Report:
    """What a solve did: residual reached, load error, Newton steps, Krylov iterations, converged."""

    residual: float
    load_error: float
    newton: int
    cycles: int
    converged: bool
    worst: int = 0


class PressureSolver:
    """Solves one step on `levels` (see :class:`Levels`); owns the Krylov memory and the preconditioner."""

    def __init__(self, levels):
        self.levels = levels
        numerics = levels.scene.numerics
        self.work = Workspace(levels.n + 1, numerics.krylov_max)
        self.preconditioner = AdditiveLines(levels)
        self.film_row, self.product = np.zeros((1, levels.n)), np.zeros((1, levels.n + 1))
        self.inside = _inside(levels)
        self.weights, self.load = load_weights(levels)
        self.H0 = 0.0

    def film(self):
        """H from the pressure in the table and H0."""
        v = self.levels
        v.deflection(v.S, fields.P, self.H0, self.film_row)
        gap_kernel.add_gap(v.S, v.G, self.film_row)

    def residual(self):
        """H, laws and R of the state in the table."""
        self.film()
        self.levels.laws()
        reynolds.residual(self.levels.S, self.levels.G, 0)

    def load_error(self):
        return float(np.sum(self.weights * self.levels.flat(fields.P))) / self.load - 1

    def mass_error(self):
        """Net outflow of the full-film region plus its storage, relative to the Couette flux through X = 0."""
        v = self.levels
        wet = (v.flat(fields.P) > 0) & (v.flat(fields.TOUCH) == 0) & self.inside
        rows = np.ones(v.ny + 1)
        rows[0] = 0.5 if v.ny else 1.0
        R = (v.flat(fields.R) * wet).reshape(v.ny + 1, -1)
        middle = int(np.argmin(np.abs(v.X)))
        couette = (v.view(fields.RHO) * v.view(fields.H))[:, middle]
        return abs(float(np.sum(rows * R.sum(axis=1)))) / float(np.sum(rows * couette))

    def solve(self, krylov_tolerance=None, tolerance=None, newton_max=None):
        """Newton iteration from the pressure in the table and H0; leaves the solution there. Returns a Report."""
        numerics = self.levels.scene.numerics
        tolerance = tolerance or numerics.tolerance
        self.residual()
        cycles = 0
        for newton in range(newton_max or numerics.newton_max):
            self._linearise()
            merit = self._merit()
            if self._converged(merit, tolerance) or not np.isfinite(merit):
                return self._report(merit, newton, cycles, tolerance)
            step, used = self._direction(krylov_tolerance or numerics.krylov_tolerance)
            cycles += used
            self._advance(step, merit, newton, tolerance)
        self._linearise()
        return self._report(self._merit(), newton + 1, cycles, tolerance)

    def _linearise(self):
        self.levels.linearise()
        self.scale = self.levels.flat(fields.D).copy()

    def _phi(self):
        v = self.levels
        gap = (v.flat(fields.H) - v.G[0, fields.FLOOR]) / v.G[0, fields.K0]
        reynolds_part = v.flat(fields.R) / self.scale
        return v.flat(fields.P), reynolds_part, gap

    def _merit(self):
        P, reynolds_part, gap = self._phi()
        phi = np.minimum(np.minimum(P, reynolds_part), gap) * self.inside
        return float(np.sqrt(np.sum(phi * phi) / self.inside.sum())) + abs(self.load_error())

    def _converged(self, merit, tolerance):
        return bool(merit < tolerance and self.mass_error() < self.levels.scene.numerics.mass_tolerance)

    def _report(self, merit, newton, cycles, tolerance):
        P, reynolds_part, gap = self._phi()
        phi = np.abs(np.minimum(np.minimum(P, reynolds_part), gap) * self.inside)
        return Report(merit, self.load_error(), newton, cycles, self._converged(merit, tolerance), int(np.argmax(phi)))

    def _sets(self):
        """Mark dry and touching nodes; right-hand side of the scaled Newton equations."""
        v = self.levels
        P, reynolds_part, gap = self._phi()
        touch = (gap < np.minimum(P, reynolds_part)) & self.inside
        dry = ((P - reynolds_part <= 0) & ~touch) | ~self.inside
        v.flat(fields.DRY)[:], v.flat(fields.TOUCH)[:] = dry, touch
        self.row_scale = np.where(dry, 1.0, np.minimum(self.scale, ROW_CAP))
        b = np.where(dry, -P, -v.flat(fields.R) / self.row_scale)
        b[~self.inside] = 0.0
        if touch.any():
            b[touch] = -self._contact_residual()[touch] / self.row_scale[touch]
        return b

    def _contact_residual(self):
        """The contact rows applied to the present violation H - H_floor."""
        v = self.levels
        gap = v.S[fields.H : fields.H + 1, : v.n] - v.G[0, fields.FLOOR]
        out = np.zeros((1, v.n))
        reynolds.jacobian(v.S, v.G, 0, np.zeros((1, v.n)), np.ascontiguousarray(gap), out, 1)
        return out[0]

    def _direction(self, krylov_tolerance):
        b = self._sets()
        self.preconditioner.build()
        self._border()
        right = np.append(b, -self.load_error() * self.load)
        step, used, _ = fgmres(self._apply, self._precondition, right, krylov_tolerance, self.work)
        step[:-1] *= self.inside
        return step, used

    def _apply(self, z):
        """Scaled Jacobian times (pressure change, H0 change)."""
        v = self.levels
        row = z[None, :]
        v.deflection(row, 0, float(z[-1]), self.film_row)
        reynolds.jacobian(v.S, v.G, 0, row, self.film_row, self.product, 1)
        out = self.product[0].copy()
        out[:-1] /= self.row_scale
        out[-1] = np.sum(self.weights * z[:-1])
        return out

    def _border(self):
        """Answer of the preconditioner to a change of H0, for the bordered system."""
        v = self.levels
        column = np.zeros((1, v.n))
        reynolds.jacobian(v.S, v.G, 0, np.zeros((1, v.n)), np.ones((1, v.n)), column, 1)
        self.lift = self.preconditioner.apply(column[0])
        self.lift[v.flat(fields.DRY) == 1.0] = 0.0
        self.lift_load = float(np.sum(self.weights * self.lift))

    def _precondition(self, r):
        z = np.empty_like(r)
        z[:-1] = self.preconditioner.apply(r[:-1] * self.row_scale)
        z[-1] = (np.sum(self.weights * z[:-1]) - r[-1]) / self.lift_load
        z[:-1] -= self.lift * z[-1]
        z[:-1] *= self.inside
        return z

    def _advance(self, step, merit, newton, tolerance):
        """Damped update: halve until the merit falls (or the change is small and the merit stays small)."""
        v = self.levels
        old_P, old_H0, t = v.flat(fields.P).copy(), self.H0, 1.0
        largest = float(np.abs(step[:-1]).max())
        while True:
            v.flat(fields.P)[:] = np.where(self.inside, np.maximum(old_P + t * step[:-1], 0.0), old_P)
            self.H0 = old_H0 + t * float(step[-1])
            self.residual()
            new = self._merit()
            falls = new < (1 - 1e-4 * t) * merit or (newton == 0 and new < 2 * merit)
            settled = t * largest < SMALL_CHANGE and new < SMALL_MERIT
            if falls or settled or new < tolerance or t < SHORTEST_STEP:
                return
            t *= 0.5


def _inside(levels):
    inside = np.zeros((levels.ny + 1, levels.nx + 1), bool)
    inside[: int(levels.G[0, fields.JN]), 1:-1] = True
    return inside.ravel()


def load_weights(levels):
    """Weights w and target such that sum(w P) = target is the load condition (model.md section 4, Hertz units).

    Line: the mean over y (trapezoid over the stored half domain) of int P dX = pi/2; point: double integral = 2 pi/3.
    """
    w_x = np.full(levels.nx + 1, levels.dx)
    if levels.ny == 0:
        return w_x, np.pi / 2
    w_y = np.full(levels.ny + 1, 1.0)
    w_y[0] = 0.5
    if levels.kind == "point":
        return np.outer(w_y * 2 * levels.dy, w_x).ravel(), 2 * np.pi / 3
    w_y[-1] = 0.5
    return np.outer(w_y / levels.ny, w_x).ravel(), np.pi / 2
