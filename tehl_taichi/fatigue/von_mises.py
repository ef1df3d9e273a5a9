"""Von Mises stress of stress histories: where the elastic bodies would yield."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import local_strength
from tehl_taichi.fatigue.stress.workers import pool

POINTS = 16  # whose stresses are found at once
NUMBERS = 100  # of a history count as one that is transformed


@dataclass(frozen=True, order=True)
class VonMisesPeak:
    """The largest von Mises stress of some points: value (Pa), depth, x, y (m, in the frame of the feature)."""

    value: float
    depth: float
    x: float
    y: float


def von_mises(stress):
    """Von Mises stress (...) of stress (..., 6): xx, yy, zz, xy, xz, yz."""
    xx, yy, zz, xy, xz, yz = np.moveaxis(stress, -1, 0)
    normal = 0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2)
    return np.sqrt(normal + 3.0 * (xy * xy + xz * xz + yz * yz))


def largest(history, of=von_mises):
    """(points,) Pa: the largest over the moments of histories (points, times, 6); of: stresses (..., 6) to what is compared."""
    parts = np.array_split(history, max(1, -(-len(history) // POINTS)))
    with pool(history.size / NUMBERS) as workers:
        return np.concatenate(list(workers.map(lambda part: of(part).max(axis=1), parts)))


def share_of(strength):
    """Function of a depth (m): by what a von Mises stress there is multiplied to be compared with the yield stress at the
    surface."""
    if not local_strength.varies_in_yield(strength):
        return lambda depth: 1.0
    return lambda depth: strength.yield_stress(0.0) / strength.yield_stress(depth)


def summary(peaks, at_the_surface, surface, strength):
    """The numbers of one body: of that of `peaks` which is nearest to its yield stress, with that at its surface (Pa), and
    whether it yields there."""
    share = share_of(strength)
    top = max(peaks, key=lambda peak: (peak.value * share(peak.depth), peak))
    limit = strength.yield_stress(top.depth)
    return {"max_Pa": top.value, "depth_m": top.depth, "x_m": top.x, "y_m": top.y, "surface": surface.name,
            "surface_max_Pa": at_the_surface, "yield_stress_Pa": limit, "yields": top.value > limit}


def peak(history, places):
    """The :class:`VonMisesPeak` of histories (points, times, 6); places(n): depth, x and y (m) of one of them."""
    values = largest(history)
    top = int(np.argmax(values))
    return VonMisesPeak(float(values[top]), *map(float, places(top)))
