"""States of a run at any moment between its stored steps: polynomials in time at each node."""

import functools
from dataclasses import dataclass

import numpy as np

from tehl_taichi.heat.chebyshev import ChebyshevNodes
from tehl_taichi.laws.density import rho_film, rho_ratio
from tehl_taichi.march.feature_gap import sink, smooth_with, with_features
from tehl_taichi.march.zoom.marched_heat import MarchedHeat
from tehl_taichi.pressure.grids import Grids
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.timeline import step_length
from tehl_taichi.values.interpolation import lagrange

POINTS = 4  # states that a polynomial uses


def weights_in_time(step, points, count):
    """[(number of a state, weight)] of the polynomial through `points` of `count` states; of one state at a whole step."""
    if abs(step - round(step)) < 1e-9:
        return [(round(step), 1.0)]
    points = min(points, count)
    first = min(max(int(step) - points // 2 + 1, 0), count - points)
    return list(zip(range(first, first + points), lagrange(range(first, first + points), step)))


@dataclass(frozen=True)
class BaseState:
    """State of the run at one moment, dimensionless.

    X: centre of the first feature, a. P, mass (rho H), bent (deflection of the bodies): (ny+1, nx+1). H0: rigid approach. T:
    temperatures (nodes across the film, ny+1, nx+1), deg C, or one number if the run is isothermal.
    """

    X: float
    P: np.ndarray
    mass: np.ndarray
    bent: np.ndarray
    H0: float
    T: np.ndarray | float

    def __mul__(self, weight):
        return BaseState(*(weight * getattr(self, name) for name in self.__dataclass_fields__))

    def __add__(self, other):
        return BaseState(*(getattr(self, name) + getattr(other, name) for name in self.__dataclass_fields__))


class BaseStates:
    """States of the run of a scene, from a reader of every step (the steady start first).

    The reader may have `surface_changes`, the changes of the surfaces by run-in, and `kept_states`, the KeptStates of the run.
    """

    def __init__(self, scene, reader):
        self.scene, self.reader, self.scales = scene, reader, Scales.of(scene)
        self.changes = getattr(reader, "surface_changes", ())
        self.grid = Grids(scene.grid, self.scales, scene.grid.nx, scene.rows, not scene.symmetric)
        self.smooth = self.grid.smooth_gap()
        self.mirrored = self.grid.ny > 0 and scene.symmetric
        self.last, self.first_x, self.way = len(reader) - 1, scene.path[0], step_length(scene)
        self.heat = None if scene.isothermal else MarchedHeat(scene, self.changes, getattr(reader, "kept_states", None))
        self.entry = functools.lru_cache(maxsize=2 * POINTS)(self._entry)

    def skip_to(self, step):
        """Allow only states from this step on (and those before it that its polynomials need): earlier heat is skipped."""
        if self.heat:
            self.heat.skip_to(step - POINTS)

    def holds(self, step):
        """Whether the states from this step on can be read several times."""
        return self.heat is None or self.heat.holds(max(step - POINTS, 0))

    def position(self, step):
        """Centre of the first feature (a) at a step; a fraction is a moment between two steps."""
        return self.first_x + step * self.way

    def at(self, step):
        """The BaseState at a step; a fraction is a moment between two steps."""
        parts = weights_in_time(step, POINTS, self.last + 1)
        if len(parts) == 1:
            return self.entry(parts[0][0])
        return functools.reduce(BaseState.__add__, (self.entry(n) * weight for n, weight in parts))

    def _entry(self, n):
        s, found = self.scales, self.reader.fields(n, ("pressure", "film"))
        p, film = (np.asarray(found[name], float).T for name in ("pressure", "film"))
        H, H0 = film / s.h, float(self.reader.scalar("h0_m")[n]) / s.h
        gap = self.gap(self.smooth, self.grid, self.position(n))
        if n == 0:  # the steady start has no features; they enter its film with the first step
            H = H + gap - smooth_with(self.grid, self.scene.standing)
        T = self.heat.at(n).T if self.heat else self.scene.operation.temperature
        return BaseState(self.position(n), p / s.p_H, self._density(p, T) * H, H - gap - H0, H0, T)

    def gap(self, smooth, levels, X):
        """Undeformed gap `smooth` of `levels` with the features at X (a, of the first one), as run-in changed them."""
        gap = with_features(smooth, levels, self.scene.surfaces, X)
        sink(gap, levels, self.scene.surfaces, self.changes, X)
        return gap

    def _density(self, p, T):
        """Mean density ratio (ny+1, nx+1) over the film thickness, from p (Pa) and T (deg C)."""
        if not self.heat:
            return rho_ratio(self.scene.film_oil, p, T)
        rho = np.broadcast_to(rho_film(self.scene.oil, p, T), T.shape)  # without expansion it depends on p alone
        return np.tensordot(ChebyshevNodes(len(T)).weights, rho, 1)
