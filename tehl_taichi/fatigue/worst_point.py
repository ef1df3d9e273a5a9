"""The worst point of a search: its stress history, its critical plane, and the moments that decide there."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import findley

AT_ONCE = 512  # points of which some moments are searched


@dataclass(frozen=True)
class Point:
    """depth, x, y (m, in the frame of the feature), Findley stress f (Pa), stress history (times, 6) Pa, the last one unloaded,
    and the unit normal of its critical plane."""

    depth: float
    x: float
    y: float
    f: float
    stress: np.ndarray
    normal: np.ndarray

    @property
    def path(self):
        """Shear along dip and along strike and normal stress on the critical plane, each (times,) Pa."""
        return findley.shear_path(self.stress, self.normal)

    @property
    def circle(self):
        """Around the shear path: centre along dip and strike, radius; Pa."""
        return findley.smallest_circle(*self.path[:2])

    def summary(self, limit):
        """Its numbers in SI; limit: sigma_eF, Pa. sigma1_worst_Pa: its largest principal stress."""
        theta, phi = (float(v[0]) for v in findley.angles(self.normal[None]))
        numbers = {"Fi_max": self.f / limit, "findley_stress_max_Pa": self.f, "x_m": self.x, "y_m": self.y,
                   "plane_theta_deg": theta, "plane_phi_deg": phi, "surface_angle_deg": theta,
                   "tau_amp_Pa": self.circle[2], "sigma_n_max_Pa": self.path[2].max(),
                   "sigma1_worst_Pa": findley.largest_principal(self.stress).max()}
        return {key: float(value) for key, value in numbers.items()}

    def moments(self, centres):
        """Positions of the feature (m) at the extremes on the critical plane; centres: its positions while loaded, m."""
        dip, strike, normal = self.path
        ends, loaded = on_circle(dip, strike, self.circle), centres.size - 1
        at = {"normal_max": int(np.argmax(normal)), "first_shear_extreme": ends[0], "last_shear_extreme": ends[-1]}
        return {f"feature_x_at_{name}_m": float(centres[min(moment, loaded)]) for name, moment in at.items()}

    def history(self, centres):
        """What figures and the store keep of it: x_a (m), stress, normal, circle."""
        return {"x_a": np.append(centres, np.nan), "stress": self.stress, "normal": self.normal, "circle": self.circle}


def worse(worst, places, history, f, normals):
    """The worst of these points, or the one so far (or None); places(n): depth, x and y (m) of one of them."""
    top = int(np.argmax(f))
    if worst is not None and f[top] <= worst.f:
        return worst
    return Point(*places(top), f[top], history[top].copy(), normals[top])


def worst_of(history, moments, fatigue, bound, places, worst=None):
    """The worst point of some of the moments, or the one so far. bound: the stress of every point over all moments, which it
    does not exceed over some: the most promising come first, and most are never looked at."""
    order = np.argsort(-bound)
    for points in np.array_split(order, max(1, order.size // AT_ONCE)):
        if worst is not None and bound[points[0]] <= worst.f:
            break
        part = history[points][:, moments]
        f, normals = findley.search(part, fatigue.kappa, criterion=fatigue.criterion)
        worst = worse(worst, lambda n, points=points: places(points[n]), part, f, normals)
    return worst


def on_circle(u, v, circle):
    """Moments at which the path (u, v) touches its smallest circle."""
    distance = np.hypot(u - circle[0], v - circle[1])
    return np.flatnonzero(distance >= distance.max() * (1 - 1e-6))
