"""Semismooth Newton for pressure and rigid approach: film, cavitation and solid contact as one complementarity.

At every unknown node  phi = min(P, R/D, (H - H_floor)/K_00) = 0:  P > 0 and the Reynolds equation holds (R = 0), or the
film has ruptured (P = 0, R >= 0), or the surfaces touch (H = H_floor, R >= 0). One more equation, the load, fixes H0.
Converged = rms of phi plus the load error below the tolerance: a residual of the discrete equations, never a step size.
"""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.kernels import deflection as gap_kernel
from tehl_taichi.kernels import fields, reynolds
from tehl_taichi.runtime import bind
from tehl_taichi.solvers.krylov import Workspace, fgmres
from tehl_taichi.solvers.preconditioner import AdditiveLines

SHORTEST_STEP = 0.05  # of a Newton step; below it a step is taken as it is and the next linearisation decides
SMALL_CHANGE = 0.05  # in P/p_H: near the solution full steps are taken although the merit may rise for a moment
SMALL_MERIT = 1e-2
# Largest row scale in the Krylov norm: the diagonal is about 0.02 in the contact but 1e3 in the inlet. Newton / Krylov per
# step over the inlet (256x64, to a mass error of 1e-6): no cap 4.2/32, at most 10/111; cap 1 3.7/38, at most 4/50; without
# the mass component of the norm and cap 0.03 3.7/58. A cap in the merit too does not converge from Hertz.
ROW_CAP = 1.0


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
        self.work = Workspace(levels.n + 2, numerics.krylov_max)
        self.preconditioner = AdditiveLines(levels)
        self.trial, self.film_row, self.product = (np.zeros((1, levels.n)) for _ in range(3))
        self._bind()
        self.inside = _inside(levels)
        self.weights, self.load = load_weights(levels)
        self.rows_weight = np.ones((levels.ny + 1, levels.nx + 1))
        if levels.ny:
            self.rows_weight[0] = 0.5  # the row y = 0 stands for half a cell
        self.rows_weight = self.rows_weight.ravel()
        self.H0 = 0.0

    def _bind(self):
        v = self.levels
        self.deflect = v.deflection.bound(v.S, fields.P, self.film_row)
        self.deflect_trial = v.deflection.bound(self.trial, 0, self.film_row)
        self.add_gap = bind(gap_kernel.add_gap, v.S, v.G, self.film_row)
        self.jacobian = bind(reynolds.jacobian, v.S, v.G, 0, self.trial, self.film_row, self.product, 1)

    def film(self):
        """H from the pressure in the table and H0."""
        self.deflect(self.H0)
        self.add_gap()

    def residual(self):
        """H, laws and R of the state in the table."""
        self.film()
        self.levels.laws()
        self.levels.evaluate_residual()

    def load_error(self):
        return float(np.sum(self.weights * self.levels.flat(fields.P))) / self.load - 1

    def mass_error(self):
        """Net outflow of the full-film region plus its storage, relative to the Couette flux through X = 0."""
        v = self.levels
        wet = (v.flat(fields.P) > 0) & (v.flat(fields.TOUCH) == 0) & self.inside
        return abs(float(np.sum(self.rows_weight * v.flat(fields.R) * wet))) / self.couette()

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
        return self._rows(0.0, self.levels.flat(fields.H) - self.levels.G[0, fields.FLOOR])

    def _rows(self, pressure, film):
        """Jacobian rows for given changes of pressure and film; a view that the next call overwrites."""
        self.trial[0], self.film_row[0] = pressure, film
        self.jacobian()
        return self.product[0]

    def _direction(self, krylov_tolerance):
        b = self._sets()
        self.preconditioner.build()
        self._border()
        self._mass_row()
        right = np.concatenate([b, [-self.load_error() * self.load, 0.0]])
        right[-1] = self.mass_row @ b
        step, used, _ = fgmres(self._apply, self._precondition, right, krylov_tolerance, self.work)
        step[:-1] *= self.inside
        return step, used

    def _apply(self, z):
        """Scaled Jacobian times (pressure change, H0 change)."""
        v = self.levels
        self.trial[0] = z[:-1]
        self.deflect_trial(float(z[-1]))
        self.jacobian()
        out = np.empty(v.n + 2)
        np.divide(self.product[0], self.row_scale, out=out[: v.n])
        out[-2] = self.weights @ z[:-1]
        out[-1] = self.mass_row @ out[: v.n]
        return out

    def _mass_row(self):
        """Weights of the scaled rows in the net mass defect, itself scaled like the sum of all rows.

        The defect is appended to the Krylov vectors as one more (redundant) component, that is, the norm gets one more
        term: row scales of 1e3 in the inlet would hide it, and it would cost three more Newton steps.
        """
        v = self.levels
        wet = (v.flat(fields.DRY) == 0) & (v.flat(fields.TOUCH) == 0)
        weight = self.rows_weight * np.sqrt(self.inside.sum()) / self.couette()
        self.mass_row = np.where(wet, weight * self.row_scale, 0.0)

    def couette(self):
        """Couette flux through X = 0, summed over the rows like the residual."""
        v = self.levels
        middle = int(np.argmin(np.abs(v.X)))
        q = (v.view(fields.RHO) * v.view(fields.H))[:, middle]
        return float(np.sum(self.rows_weight.reshape(v.ny + 1, -1)[:, middle] * q))

    def _border(self):
        """Answer of the preconditioner to a change of H0, for the bordered system."""
        v = self.levels
        self.lift = self.preconditioner.apply(self._rows(0.0, 1.0))
        self.lift[v.flat(fields.DRY) == 1.0] = 0.0
        self.lift_load = float(np.sum(self.weights * self.lift))

    def _precondition(self, r):
        z = np.empty(r.size - 1)
        z[:-1] = self.preconditioner.apply(r[:-2] * self.row_scale)
        z[-1] = (self.weights @ z[:-1] - r[-2]) / self.lift_load
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
