"""Conduction into the bodies: a half-space whose thermal history is stored in a few decaying modes.

Each material strip of a body's surface is a one-dimensional half-space (Carslaw & Jaeger, section 2.9; at large Peclet numbers
conduction along the surface is negligible): T_s(t) = T_0 + int q(t') K(t - t') dt', K = 1/sqrt(pi k rho c t). With K as a sum
of exponentials the history becomes a few numbers per strip, and the flux of the present step (linear in time) is exact: T_s = A
+ B q, B = (4/3) sqrt(dt/pi)/sqrt(k rho c), equal at every node.

A slow surface of a point contact also conducts sideways (:func:`widths`): K falls by 1/sqrt((1 + 4 alpha t/w_x^2)(1 + 4 alpha
t/w_y^2)), as beside a Gaussian spot of widths w (Carslaw & Jaeger, section 10.3). A surface at rest of a line contact has no
steady temperature on a half-space. It gets a slab of depth REST (in a) at ambient temperature below; its resistance, depth/k,
is about that of a strip of width 2a on a body about 10 a thick.
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

MODES = 16  # to 4e-5 of the surface temperature from the shortest step to the horizon; 12 modes: 1e-3
HORIZON = 2e4  # steps that a strip spends on the grid at most (a surface at a hundredth of the speed of the other)
# Part of a step that the modes are fitted for; in parts of 1/64, the shortest ever taken, 9 % of what the part before has
# heated are missing, 3 % of the one before that
SHORTEST = 1 / 16
REST = 3.0  # a
FAST = 100.0  # Peclet number from which on heat that is lost sideways changes no temperature by more than 1 %
NONE = math.inf, math.inf
LONG = 1e4  # of the larger spread: the tail of K after it holds 0.6 % of a steady temperature
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(12)


class ModeMemory(NamedTuple):
    """Modes of a body in a step: for each mode (MODES,) its weight, its decay over the step, and its gains by the new and the
    last flux; B of T_s = A + B q; B of the last flux, which is part of A.
    """

    weight: np.ndarray
    decay: np.ndarray
    gain: np.ndarray
    gain_last: np.ndarray
    B: float
    B_last: float


def is_fast(peclet, a, b):
    """Whether a surface moves too fast to lose heat sideways; peclet: u a/alpha; a, b: half-axes in one unit."""
    return peclet * min(1.0, b / a) ** 2 > FAST


def widths(peclet, a, b):
    """Widths (w_x, w_y) of the spot that describes sideways conduction of an elliptic contact, in the unit of its half-axes a
    and b.

    peclet: u a/alpha. Fitted to exact steady temperatures of moving half-spaces under Hertzian fluxes (docs/decisions/03);
    errors: :data:`tehl_taichi.scene.slow_surfaces.ERRORS`.
    """
    ratio = b / a
    return a * (0.94 + 0.88 * ratio**0.44 * peclet**0.6), b * (0.89 * ratio**-0.03 + 0.014 * peclet * ratio**1.7)


def memory(dt, effusivity, base_dt, depth=math.inf, spread=NONE):
    """The ModeMemory for a step of dt s with a flux linear in time, fitted for steps of base_dt s.

    effusivity: sqrt(k rho c) of the body, SI; depth: of a slab, over sqrt(diffusivity base_dt), infinite for a half-space;
    spread: w^2/(4 alpha base_dt) of both :func:`widths`, infinite without sideways conduction.
    """
    rates, weights = _fit(depth, spread)
    rates, weights = rates / base_dt, weights / (effusivity * math.sqrt(base_dt))
    mean = -np.expm1(-rates * dt) / (rates * dt)
    B = 2 * math.sqrt(dt / math.pi) / effusivity
    decay = np.exp(-rates * dt)
    return ModeMemory(weights, decay, (1 - mean) / rates, (mean - decay) / rates, 2 * B / 3, B / 3)


def steady_modes(base_dt, depth, spread=NONE):
    """Modes after a long time, per unit flux, (MODES,)."""
    return base_dt / _fit(depth, spread)[0]


@lru_cache(maxsize=8)
def _fit(depth, spread):
    """Rates and weights for a step of 1 and effusivity 1: least-squares fit of the response to the flux of one shortest step,
    at all later times, relative to the exact response.
    """
    slowest, horizon = _range(depth, spread)
    n = np.unique(np.round(np.geomspace(1, horizon / SHORTEST, 600))) * SHORTEST
    exact = _lost(n, spread) if spread != NONE else _warmed(n + SHORTEST, depth) - _warmed(n, depth)
    rates = np.geomspace(slowest, 6.0 / SHORTEST, MODES)
    response = (1 - np.exp(-rates * SHORTEST)) / rates * np.exp(-rates * n[:, None])
    weights = np.linalg.lstsq(response / exact[:, None], np.ones(n.size), rcond=None)[0]
    return rates, weights


def _range(depth, spread):
    """(slowest rate, last time) of a fit."""
    if not math.isinf(depth):
        return math.pi**2 / (4 * depth**2), depth**2
    longest = max(HORIZON, LONG * max(spread)) if spread != NONE else HORIZON
    return 0.3 / longest, longest


def _lost(t, spread):
    """Response at time t to a unit flux over one shortest step, after that step, with sideways conduction: Gauss integration of
    K over the step in its square root.
    """
    first, last = np.sqrt(t)[:, None], np.sqrt(t + SHORTEST)[:, None]
    s = (0.5 * (first + last) + 0.5 * (last - first) * POINTS) ** 2
    K = 2 / np.sqrt(math.pi * (1 + s / spread[0]) * (1 + s / spread[1]))
    return 0.5 * (last - first)[:, 0] * (K @ WEIGHTS)


def _warmed(t, depth):
    """Surface temperature after a time t of unit flux: half-space, or slab by its own series."""
    half_space = 2 * np.sqrt(t / math.pi)
    if math.isinf(depth):
        return half_space
    odd = (2 * np.arange(60) + 1.0) ** 2
    slab = depth * (1 - 8 / math.pi**2 * (np.exp(-odd * math.pi**2 / 4 / depth**2 * t[:, None]) / odd).sum(axis=1))
    return np.where(t < 0.02 * depth**2, half_space, slab)
