"""Fatigue of the material around a feature: stress histories, critical planes, the index."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.post import findley
from tehl_taichi.post.passage import Passage
from tehl_taichi.scene import SceneError

PIT_ANGLES = (18.0, 50.0)  # degrees to the surface at which pits begin (Everitt 2018)


@dataclass(frozen=True)
class FatigueResult:
    """summary: numbers in SI; maps: name -> (values, dimensions, units, text), of the surface, in the frame of the feature;
    worst: history of the worst point: x_a (m), stress (times, 6) Pa (the last one unloaded), normal (3,), circle
    around the shear path (centre along dip and strike, radius; Pa)."""

    summary: dict
    maps: dict
    worst: dict


class Snapshots:
    """A list of snapshots (all of one grid) as the reader that :func:`run` wants."""

    def __init__(self, snapshots):
        self.items = list(snapshots)
        self.x, self.y = self.items[0].x, self.items[0].y
        self.time = np.array([s.time for s in self.items])

    def __len__(self):
        return len(self.items)

    def feature_x(self, n):
        """Centre of the feature (m) at entry n."""
        return self.items[n].feature_x

    def fields(self, n, names):
        """{name: (nx+1, ny+1) array} of entry n."""
        return {name: self.items[n].fields[name] for name in names}


def run(scene, reader, progress=None):
    """Fatigue index of the points of body a within 0.6 a of the first feature (0.3 a beyond larger ones), over its passage.

    At the surface and at scene.fatigue.depths, between its from_x and to_x, by its criterion. reader: see
    :class:`tehl_taichi.post.passage.Passage`; or a list of snapshots. progress: called with (done, total) parts of a pass.
    On the rows of the reader (where they begin with y = 0, the others are its mirror). Memory: one block of histories
    (400 MB at most), with thermal stress 8 bytes more per entry and wave number (4 nodes of the grid).
    Raises SceneError when no feature passes.
    """
    reader = Snapshots(reader) if isinstance(reader, (list, tuple)) else reader
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    if len(reader) < 2 or not np.isfinite(centres).all():
        raise SceneError("fatigue needs the passage of a feature: a scene with a feature and at least one time step")
    passage = Passage(scene, reader, centres)
    if passage.centres.size < 2:
        f = scene.fatigue
        raise SceneError(f"the feature is at no stored moment between fatigue.from_x = {f.from_x:g} a and to_x = {f.to_x:g} a; "
                         f"it goes from {centres[0] / passage.a:.2f} to {centres[-1] / passage.a:.2f} a")
    layers = [_layer(scene, passage, depth, progress) for depth in (0.0, *scene.fatigue.depths)]
    return _result(scene, passage, layers)


@dataclass(frozen=True)
class Layer:
    """What was found at one depth: maps (nx, rows) and the history of the worst point (place, stress, normal)."""

    depth: float
    f: np.ndarray
    theta: np.ndarray
    phi: np.ndarray
    sigma1: np.ndarray
    place: tuple
    stress: np.ndarray
    normal: np.ndarray


def _layer(scene, passage, depth, progress):
    operators, parts, worst = passage.stresses(depth), [], (-np.inf,)
    for rows in passage.row_blocks():
        history = passage.history(rows, operators, progress)
        f, normals = findley.search(history, scene.fatigue.kappa, criterion=scene.fatigue.criterion)
        shape = passage.x.size, rows.stop - rows.start
        sigma1 = np.array([findley.largest_principal(part).max() for part in history])
        parts.append([v.reshape(shape) for v in (f, *findley.angles(normals), sigma1)])
        top = int(np.argmax(f))
        if f[top] > worst[0]:
            i, j = np.unravel_index(top, shape)
            worst = f[top], (int(i), int(j) + rows.start), history[top].copy(), normals[top]
    return Layer(depth, *(np.concatenate(part, axis=1) for part in zip(*parts)), *worst[1:])


def _result(scene, passage, layers):
    worst, limit = max(layers, key=lambda layer: layer.f.max()), scene.fatigue.endurance
    (i, j), f = worst.place, worst.f
    circle = findley.smallest_circle(*findley.shear_path(worst.stress, worst.normal)[:2])
    summary = {"Fi_max": f[i, j] / limit, "findley_stress_max_Pa": f[i, j], "x_m": passage.x[i], "y_m": passage.y[j],
               "plane_theta_deg": worst.theta[i, j], "plane_phi_deg": worst.phi[i, j],
               "surface_angle_deg": worst.theta[i, j], "sigma1_max_Pa": max(layer.sigma1.max() for layer in layers),
               "kappa_F": scene.fatigue.kappa, "sigma_eF_Pa": limit, **_moments(passage, worst, circle)}
    summary = {key: float(value) for key, value in summary.items()}
    summary |= {"criterion": scene.fatigue.criterion, "thermal_stress": scene.thermal_stress_wanted,
                "pit_angles_deg": list(PIT_ANGLES)}
    if len(layers) > 1:
        summary |= {"depth_m": worst.depth, "by_depth": [
            {"depth_m": layer.depth, "findley_stress_max_Pa": float(layer.f.max())} for layer in layers]}
    history = {"x_a": np.append(passage.centres, np.nan), "stress": worst.stress, "normal": worst.normal,
               "circle": circle}
    return FatigueResult(summary, {**_maps(passage, layers, limit), **_history_maps(history)}, history)


def _history_maps(worst):
    """The history of the worst point as a store keeps it."""
    return {"worst_x_a": (worst["x_a"], ["moment"], "m", "centre of the feature; the last moment is unloaded"),
            "worst_stress": (worst["stress"], ["moment", "component"], "Pa", "xx, yy, zz, xy, xz, yz at the worst point"),
            "worst_normal": (worst["normal"], ["direction"], "1", "unit normal of its critical plane"),
            "worst_circle": (worst["circle"], ["of_circle"], "Pa", "around its shear path: centre along dip, strike; radius")}


def _moments(passage, worst, circle):
    """Positions of the feature (m) at the extremes on the critical plane, and its stresses."""
    dip, strike, normal = findley.shear_path(worst.stress, worst.normal)
    ends, loaded = on_circle(dip, strike, circle), passage.centres.size - 1
    return {"feature_x_at_normal_max_m": passage.centres[min(int(np.argmax(normal)), loaded)],
            "feature_x_at_first_shear_extreme_m": passage.centres[min(ends[0], loaded)],
            "feature_x_at_last_shear_extreme_m": passage.centres[min(ends[-1], loaded)], "tau_amp_Pa": circle[2],
            "sigma_n_max_Pa": normal.max()}


def on_circle(u, v, circle):
    """Moments at which the path (u, v) touches its smallest circle."""
    distance = np.hypot(u - circle[0], v - circle[1])
    return np.flatnonzero(distance >= distance.max() * (1 - 1e-6))


def _maps(passage, layers, limit):
    """Of the surface; with depths, the largest of each depth too."""
    both, surface = ["feature_frame_x", "feature_frame_y"], layers[0]
    out = {both[0]: (passage.x, both[:1], "m", "along rolling, from the centre of the feature"),
           both[1]: (passage.y, both[1:], "m", "across, from the centre of the contact"),
           "findley_stress": (surface.f, both, "Pa", "Findley stress"), "Fi": (surface.f / limit, both, "1", "Findley index"),
           "sigma1_max": (surface.sigma1, both, "Pa", "largest principal stress of the passage"),
           "plane_theta": (surface.theta, both, "degree", "angle of the critical plane's normal from the surface normal"),
           "plane_phi": (surface.phi, both, "degree", "direction of the critical plane's normal in the surface, from x")}
    if len(layers) > 1:
        out["fatigue_depth"] = (np.array([layer.depth for layer in layers]), ["fatigue_depth"], "m", "below the surface")
        out["findley_stress_at_depth"] = (np.stack([layer.f for layer in layers]), ["fatigue_depth", *both], "Pa",
                                          "Findley stress")
    return out
