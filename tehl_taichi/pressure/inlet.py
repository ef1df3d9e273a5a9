"""Pressure of the oil beyond the border of the grid, for an inlet that is flooded without end.

Far before the contact this pressure hardly deflects the bodies, so the Reynolds equation can be integrated. With the reduced
pressure q(p) = int_0^p eta_0/eta dp, a line has q = 12 eta_0 u_m int (h - h*)/h^3 dx beyond the border, where h* is the flow
over u_m. A point has the value of two rigid paraboloids, q = 12 eta_0 u_m |x|/((3 + 2 R_x/R_y) h^2), exact for thick gaps, with
the film at the node and half the correction of a line's integral. eta_0: viscosity of the column at the border.
"""

import functools

import numpy as np

from tehl_taichi.laws.viscosity import ln_eta
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.grids import load_weights
from tehl_taichi.scene.film_formula import central_film

T, WEIGHTS = (0.5 * part for part in np.polynomial.legendre.leggauss(40))
T = T + 0.5  # X = X_border/T beyond the border
PRESSURES = np.concatenate([[0.0], np.geomspace(1e2, 3e9, 800)])  # Pa
MOST = 0.95  # of the reduced pressure that the oil reaches at all
AGREES = 1e-4  # of the same: border and film, which a border changes by its share of it
# Of a miss that a move makes up for, at least: thick films answer a border by up to -1.4 times its move, back and forth. Beside
# gaps of less than two films they answer by more: misses that come back in turn with more than SWINGS of their size quarter it
LEAST, SWINGS = 0.5, 0.7


@functools.lru_cache(maxsize=16)
def reduced(oil, Gamma):
    """(p, q) in Pa: reduced pressure of an oil at Gamma deg C; between its points 1/eta is exponential."""
    ln = np.array([ln_eta(oil, float(p), Gamma) for p in PRESSURES])
    fall = np.diff(ln)
    near = np.abs(fall) < 1e-6
    mean = np.where(near, 1 - fall / 2, -np.expm1(-fall) / np.where(near, 1.0, fall))
    return PRESSURES, np.concatenate([[0.0], np.cumsum(np.diff(PRESSURES) * np.exp(ln[0] - ln[:-1]) * mean)])


def far(X, H, log):
    """(places, films, integration weights) beyond X, from the film H there.

    log: 1 for a line contact, whose bodies deflect logarithmically, 0 for a point.
    """
    return X / T, H + 0.5 * X**2 * (1 / T**2 - 1) + 0.5 * log * np.log(T), WEIGHTS * abs(X) / T**2


def integral(beyond, carried):
    """int (film - carried)/film^3 dX of the oil `beyond`, a result of :func:`far`."""
    _, gap, weights = beyond
    return float(np.sum(weights * (gap - carried) / gap**3))


class Inlet:
    """Pressure of the oil beyond the border of the grid of `levels`.

    Border nodes: the first column, and before the contact (X < 0) the sides of a point contact.
    """

    def __init__(self, levels):
        self.levels, v = levels, levels
        self.flooded = v.scene.grid.inlet == "flooded"
        self.border = np.zeros((v.ny + 1, v.nx + 1), bool)
        self.border[:, 0] = True
        if not v.line:
            self.border[-1, v.X < 0] = True
            self.border[0, v.X < 0] |= not v.mirrored
        self.p, self.q = reduced(v.scene.oil, v.scene.operation.temperature)
        self._first()

    def now(self):
        """Reduced pressure (Pa) at the border nodes in the table."""
        return np.interp(self.levels.get(fields.P)[self.border] * self.levels.scales.p_H, self.p, self.q)

    def put(self, q):
        """Set this reduced pressure (Pa) at the border nodes."""
        P = self.levels.get(fields.P)
        P[self.border] = self._pressure(q)
        self.levels.put(fields.P, P)

    def _pressure(self, q):
        """Pressure, over that of Hertz, of oil with this reduced pressure (Pa)."""
        return np.interp(np.minimum(q, MOST * self.q[-1]), self.q, self.p) / self.levels.scales.p_H

    def follow(self):
        """Move the border pressure towards that of the oil beyond it, by a part that accounts for the film's response to the
        last move (Aitken). Returns whether it moved.
        """
        return self._move(self._aitken)

    def move(self, part):
        """Move the border pressure by this part of its deviation."""
        return self._move(lambda miss: part)

    def _move(self, part_of):
        """Move the border pressure by part_of(its deviation), unless it agrees."""
        miss = self.miss()
        moved = not self._small(miss)
        if moved:
            self.put(self.now() + part_of(miss) * miss)
        return moved

    def _aitken(self, miss):
        self.part, self.before = self._part(miss), miss
        return self.part

    def _first(self):
        """Forget earlier moves: part of the last one and the miss before it, smallest part, misses that came back in turn."""
        self.part, self.before, self.least, self.swings = 1.0, None, LEAST, 0

    def _part(self, miss):
        if self.before is None or not (step := miss - self.before).any():
            return self.part
        self.swings = self.swings + 1 if miss @ self.before < -SWINGS * (self.before @ self.before) else 0
        if self.swings > 1:
            self.least /= 4
        return float(np.clip(-self.part * (self.before @ step) / (step @ step), self.least, 1.0))

    def miss(self):
        """Deviation (Pa) of the reduced pressure at the border from that of the oil beyond it."""
        return np.minimum(self.beyond(), MOST * self.q[-1]) - self.now()

    def agrees(self):
        """Whether border and film agree."""
        return self._small(self.miss())

    def _small(self, miss):
        return bool(np.abs(miss).max() <= AGREES * self.q[-1])

    def begin(self, gap):
        """Set the border pressure for a film by formula; gap: of the dry contact."""
        film = central_film(self.levels.scene) / self.levels.scales.h
        self._first()
        self.put(self.without_heat(gap + film, film))

    def beyond(self):
        """Reduced pressure (Pa) of the oil beyond the border, for the film in the table."""
        H = self.levels.get(fields.H)
        return self.without_heat(H, self.carried(H)) * self.warmth()

    def without_heat(self, H, carried):
        """Border pressure for the film H with flow `carried`, for oil at the inlet viscosity."""
        v = self.levels
        if v.line:
            shape = np.full(v.ny + 1, integral(self.far(H), carried))
        else:
            X = np.broadcast_to(v.X, H.shape)[self.border]
            shape = self._kappa(H, carried) * np.abs(X) / ((3 + 2 * v.scales.curvature) * H[self.border] ** 2)
        return np.maximum(shape, 0.0) * v.scales.p_H / v.numbers.inv_lambda

    def far(self, H):
        """(places, films, integration weights) before the grid in the middle row, for the film H on the grid."""
        v = self.levels
        return far(v.X[0], H[v.middle, 0], float(v.line))

    def carried(self, H):
        """Flow rho H at X = 0, relative to the density at the inlet."""
        v = self.levels
        return float(np.interp(0.0, v.X, (H * v.get(fields.RHO))[v.middle]))

    def load(self):
        """Load of the oil beyond the border, in the units of :func:`tehl_taichi.pressure.grids.load_weights`; 0 without
        such oil.
        """
        if not self.flooded:
            return 0.0
        return self._load_of_line() if self.levels.line else self._load_of_point()

    def _load_of_line(self):
        v = self.levels
        H = v.get(fields.H)
        X, gap, weights = self.far(H)
        shape = np.sum(weights * (np.abs(X) - abs(v.X[0])) * (gap - self.carried(H)) / gap**3)
        return max(float(shape), 0.0) / v.numbers.inv_lambda

    def _load_of_point(self):
        """The pressure at each node of the border, times the area of its triangle with the centre, times twice the integral of
        s q(s) along the ray, where q is |X|/gap^2 and the gap grows as that of the rigid bodies; s = 1 at the border.
        """
        v = self.levels
        P, cell = np.zeros(self.border.shape), load_weights(v)[:, 0] / v.dx
        P[self.border] = self._pressure(self.beyond())
        growth = v.smooth_gap() / v.get(fields.H)
        beyond = P * sum(w / t**4 / (1 + growth * (1 / t**2 - 1)) ** 2 for t, w in zip(T, WEIGHTS))
        load = (abs(v.X[0]) + v.dx / 2) * cell @ beyond[:, 0]
        for row in [-1, -1] if v.mirrored else [0, -1]:
            load += (abs(v.Y[row]) - v.dy / 2) * v.dx * beyond[row, v.X < 0].sum()
        return float(load)

    def _kappa(self, H, carried):
        """Correction of a point contact: mean of 1 and the ratio of the integral along y = 0 to that of a gap ~ X^2."""
        v = self.levels
        return 0.5 + 1.5 * integral(self.far(H), carried) * H[v.middle, 0] ** 2 / abs(v.X[0])

    def warmth(self):
        """Viscosity at the border nodes relative to that of inlet oil at their pressure."""
        v = self.levels
        p = v.get(fields.P)[self.border] * v.scales.p_H
        cold = ln_eta(v.scene.oil, p, v.scene.operation.temperature) - v.conditions["ln_eta0"]
        return np.exp(v.get(fields.LE)[self.border] - cold)
