"""Conduction into the bodies: a half-space that remembers the heat of earlier steps in a few decaying modes.

Each material strip of a body's surface is a one-dimensional half-space (Carslaw & Jaeger, section 2.9; conduction along the
surface is negligible at the Peclet numbers of these contacts): T_s(t) = T_0 + int q(t') K(t - t') dt', K = 1/sqrt(pi k rho c
t). With K as a sum of exponentials the history becomes a few numbers per strip, and the flux of the running step (linear in
time) enters exactly: T_s = A + B q, B = (4/3) sqrt(dt/pi)/sqrt(k rho c), the same at every node.
"""

import math
from functools import lru_cache

import numpy as np

MODES = 16  # to 4e-5 of the surface temperature from the shortest step to the horizon; 12 modes: 1e-3
HORIZON = 2e4  # steps that a strip spends on the grid at most (a surface at a hundredth of the speed of the other)
SHORTEST = 1 / 16  # part of a step that is ever taken


def memory(dt, effusivity, base_dt):
    """(rows of MODES numbers: weight, decay over dt, gain of the new flux and of the last; B of the new flux, of the last)
    for a step of dt s with a flux linear in time, fitted for steps of base_dt s.

    effusivity: sqrt(k rho c) of the body, SI.
    """
    rates, weights = _fit()
    rates, weights = rates / base_dt, weights / (effusivity * math.sqrt(base_dt))
    mean = -np.expm1(-rates * dt) / (rates * dt)
    B = 2 * math.sqrt(dt / math.pi) / effusivity
    return np.array([weights, np.exp(-rates * dt), (1 - mean) / rates, (mean - np.exp(-rates * dt)) / rates]), 2 * B / 3, B / 3


@lru_cache(maxsize=1)
def _fit():
    """Rates and weights for a step of 1 and effusivity 1: least squares on the response to the flux of one shortest step, at
    all later times, relative to the exact 2/sqrt(pi) (sqrt(t + dt) - sqrt(t))."""
    n = np.unique(np.round(np.geomspace(1, HORIZON / SHORTEST, 600))) * SHORTEST
    exact = 2 / math.sqrt(math.pi) * (np.sqrt(n + SHORTEST) - np.sqrt(n))
    rates = np.geomspace(0.3 / HORIZON, 6.0 / SHORTEST, MODES)
    response = (1 - np.exp(-rates * SHORTEST)) / rates * np.exp(-rates * n[:, None])
    weights = np.linalg.lstsq(response / exact[:, None], np.ones(n.size), rcond=None)[0]
    return rates, weights
