"""One column of a film, summed across it: flow, stress in the middle and slip along walls, from the law alone (an oracle)."""

import numpy as np

V, WEIGHTS = np.polynomial.legendre.leggauss(400)
Z = np.sin(0.5 * np.pi * V)  # -1 to 1 across the film: roots at the walls, where a limit is met, become smooth
SHARE = WEIGHTS * 0.25 * np.pi * np.cos(0.5 * np.pi * V)


def limiting(t):
    return t / np.sqrt(np.maximum(1 - t * t, 1e-300))


def carreau(n):
    """The rate by Newton's method for its logarithm, which rises to it from below: the stress is concave there."""
    def rate(t):
        y = known = np.log(np.maximum(np.abs(t), 1e-30))
        for _ in range(60):
            step = (known - y - 0.5 * (n - 1) * np.log1p(np.exp(2 * y))) / (1 + (n - 1) / (1 + np.exp(-2 * y)))
            y = y + step
            if np.abs(step).max() < 1e-14:
                break
        return np.sign(t) * np.exp(y)

    return rate


def column(rate, wall, sliding, limit=np.inf, fluidity=1.0):
    """rate(stress): of oil of viscosity 1; all stresses over one; fluidity: 1/eta at the places Z, of mean 1. Returns what a
    gradient along the sliding drives over Newtonian oil of that viscosity, the stress in the middle, and the slip along walls
    as a part of the sliding."""
    sliding = max(sliding, 1e-300)

    def slid(mean):
        return SHARE @ (fluidity * rate(mean + wall * Z))

    most = limit - wall
    if np.isfinite(limit) and slid(most) < sliding:
        mean, slip = most, sliding - slid(most)
    else:
        low, high, slip = -sliding * 1e3 - wall, min(sliding * 1e3 + wall, most), 0.0
        for _ in range(200):
            mean = 0.5 * (low + high)
            if mean in (low, high):
                break
            low, high = (mean, high) if slid(mean) < sliding else (low, mean)
    carried = SHARE @ (fluidity * Z * rate(mean + wall * Z)) + slip
    return 3 * carried / wall, mean, slip / sliding
