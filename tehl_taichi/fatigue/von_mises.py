"""Von Mises stress of stress histories, and where the elastic bodies would yield."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue.stress.workers import pool

POINTS = 16  # points of one task
NUMBERS = 100  # numbers of a history that cost as much as one number of a transform (decides whether threads are used)


@dataclass(frozen=True, order=True)
class VonMisesPeak:
    """The largest von Mises stress of some points: value (Pa), depth, x, y (m, in the frame of the feature)."""

    value: float
    depth: float
    x: float
    y: float


def von_mises(stress):
    """Von Mises stress (...) of stresses (..., 6): xx, yy, zz, xy, xz, yz; same unit."""
    xx, yy, zz, xy, xz, yz = np.moveaxis(stress, -1, 0)
    normal = 0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2)
    return np.sqrt(normal + 3.0 * (xy * xy + xz * xz + yz * yz))


def largest(history, of=von_mises):
    """Largest value over the moments, (points,) Pa, of histories (points, times, 6) Pa; of: function of stresses (..., 6)."""
    parts = np.array_split(history, max(1, -(-len(history) // POINTS)))
    with pool(history.size / NUMBERS) as workers:
        return np.concatenate(list(workers.map(lambda part: of(part).max(axis=1), parts)))


def share_of(strength):
    """Function of a depth (m) that returns yield stress at the surface / yield stress there."""
    return lambda depth: strength.yield_stress(0.0) / strength.yield_stress(depth)


def summary(peaks, at_the_surface, surface, strength):
    """Summary of one body, {name: number}, for the peak that is closest to the yield stress of its depth.

    peaks: list of VonMisesPeak; at_the_surface: largest von Mises stress at the surface, Pa; surface: the MovingSurface;
    strength: its Strength, without whose yield stress `yields` is None.
    """
    share = share_of(strength)
    top = max(peaks, key=lambda peak: (peak.value * share(peak.depth), peak))
    limit = strength.yield_stress(top.depth)
    yields = top.value > limit if strength.knows_yield_stress else None
    return {"max_Pa": top.value, "depth_m": top.depth, "x_m": top.x, "y_m": top.y, "surface": surface.name,
            "surface_max_Pa": at_the_surface, "yield_stress_Pa": limit, "yields": yields}


def peak(history, places):
    """The :class:`VonMisesPeak` of histories (points, times, 6) Pa; places(n): (depth, x, y) in m of point n."""
    values = largest(history)
    top = int(np.argmax(values))
    return VonMisesPeak(float(values[top]), *map(float, places(top)))
