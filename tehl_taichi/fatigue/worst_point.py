"""Worst point of a search: its stress history, its critical plane, and the decisive moments."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import findley
from tehl_taichi.scene.strength.strength import LocalStrength

AT_ONCE = 512  # points of which some moments are searched
# share of the largest stress from which a point may be the worst by more moments, and the most points that are kept. A dent and
# an asperity with temperatures at SRR 0.12 on 512x128 cells, averaged over 10 um: the worst points by all moments have at least
# 0.991 of the largest stress by every fourth one, 7 to 13 points 0.99, 9 to 27 points 0.98
CLOSE, MOST = 0.98, 32


@dataclass(frozen=True)
class WorstPoint:
    """depth, x, y (m, in the frame of the feature), Findley stress f (Pa), stress history (times, 6) Pa, the last one unloaded,
    the unit normal of its critical plane, and the LocalStrength there. positions: of the feature at its moments but the last,
    m, if they are not those of the search."""

    depth: float
    x: float
    y: float
    f: float
    stress: np.ndarray
    normal: np.ndarray
    local: LocalStrength
    positions: np.ndarray | None = None

    @property
    def compared(self):
        """Stress (Pa) times the ratio of the limits at the surface and here; the largest one has the largest index."""
        return self.f * self.local.share

    @property
    def path(self):
        """Shear along dip and along strike and normal stress on the critical plane, each (times,) Pa."""
        return findley.shear_path(self.stress, self.normal)

    @property
    def circle(self):
        """Smallest circle around the shear path: centre along dip and strike, radius; Pa."""
        return findley.smallest_circle(*self.path[:2])

    def summary(self):
        """Numbers in SI units. sigma1_worst_Pa: largest principal stress."""
        theta, phi = (float(v[0]) for v in findley.angles(self.normal[None]))
        numbers = {"Fi_max": self.f / self.local.endurance, "findley_stress_max_Pa": self.f, "x_m": self.x, "y_m": self.y,
                   "plane_theta_deg": theta, "plane_phi_deg": phi, "surface_angle_deg": theta,
                   "tau_amp_Pa": self.circle[2], "sigma_n_max_Pa": self.path[2].max(),
                   "sigma1_worst_Pa": findley.largest_principal(self.stress).max()}
        return {key: float(value) for key, value in numbers.items()}

    def moments(self, centres):
        """Positions of the feature (m) at the extremes on the critical plane; centres: its positions in the search, m."""
        centres = centres if self.positions is None else self.positions
        dip, strike, normal = self.path
        ends, loaded = on_circle(dip, strike, self.circle), centres.size - 1
        at = {"normal_max": int(np.argmax(normal)), "first_shear_extreme": ends[0], "last_shear_extreme": ends[-1]}
        return {f"feature_x_at_{name}_m": float(centres[min(moment, loaded)]) for name, moment in at.items()}

    def history(self, centres):
        """Data for figures and the store: x_a (m), stress, normal, circle; centres: as for :meth:`moments`."""
        centres = centres if self.positions is None else self.positions
        return {"x_a": np.append(centres, np.nan), "stress": self.stress, "normal": self.normal, "circle": self.circle}


def worst_of(points):
    """The point with the largest index; None without points."""
    return max(points, key=lambda point: point.compared, default=None)


def worse(worst, places, history, f, normals, local):
    """Worst of these points at one depth and of `worst` (or None); places(n): depth, x and y (m) of a point; local:
    LocalStrength of the depth.
    """
    top = int(np.argmax(f))
    if worst is not None and f[top] <= worst.f:
        return worst
    return WorstPoint(*places(top), f[top], history[top].copy(), normals[top], local)


def close_ones(points, places, history, f, normals, local):
    """The worst of these points and of `points` (WorstPoints), which may be the worst by more moments; other arguments as for
    :func:`worse`.
    """
    least = CLOSE * max([float(f.max()), *(point.f for point in points)])
    new = [WorstPoint(*places(n), f[n], history[n].copy(), normals[n], local)
           for n in np.argsort(-f)[:MOST] if f[n] >= least]
    known = [point for point in points if point.f >= least]
    return sorted(known + new, key=lambda point: -point.f)[:MOST]


def over_some(history, moments, passage, depth, places, known, worst=None):
    """(stress of every point, Pa, worst point or `worst`) for some of the moments; known: (f, normals) for all moments. A few
    points at a time, because the selection copies their histories.
    """
    f, local, brief = np.empty(len(history)), passage.strength.at(depth), passage.sought.brief
    for first in range(0, len(history), AT_ONCE):
        points = slice(first, first + AT_ONCE)
        part = history[points, moments]
        whole = [values[points] for values in known] if known else None
        f[points], normals = findley.search(part, local.kappa, criterion=local.criterion, known=whole, worst=brief)
        worst = worse(worst, lambda n, first=first: places(first + n), part, f[points], normals, local)
    return f, worst


def on_circle(u, v, circle):
    """Moments at which the path (u, v) touches its smallest circle."""
    distance = np.hypot(u - circle[0], v - circle[1])
    return np.flatnonzero(distance >= distance.max() * (1 - 1e-6))
