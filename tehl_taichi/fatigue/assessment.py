"""Fatigue of the material around a feature: stress histories, critical planes, the index."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.fatigue import depth_search
from tehl_taichi.fatigue.histories import Passage
from tehl_taichi.fatigue.layer import layer
from tehl_taichi.fatigue.told import Told
from tehl_taichi.scene import SceneError

PIT_ANGLES = (18.0, 50.0)  # degrees to the surface at which pits begin (Everitt 2018)


@dataclass(frozen=True)
class FatigueResult:
    """summary: numbers in SI, of the surface, and of what lies below it in its "below"; maps: name -> (values, dimensions,
    units, text), in the frame of the feature; worst: history of the worst point of the surface: x_a (m), stress (times, 6) Pa
    (the last one unloaded), normal (3,), circle around the shear path (centre along dip and strike, radius; Pa); worst_below:
    the same of the worst point below, or None where only the surface was searched."""

    summary: dict
    maps: dict
    worst: dict
    worst_below: dict


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


def run(scene, reader, progress=None, until=None):
    """Fatigue index of the points of body a within 0.6 a of the first feature (0.3 a beyond larger ones), over its passage.

    At all points of the surface and, unless scene.fatigue.depths is empty, below it: under the row through the feature (and the
    surface's worst row), the depth looked for (:mod:`tehl_taichi.fatigue.below`), on a whole domain at all points of that
    depth, too (:mod:`tehl_taichi.fatigue.depth_search`); where depths are listed also at all points at these.
    Between its from_x and to_x, by its criterion. reader: see :class:`tehl_taichi.fatigue.histories.Passage`; or a list of
    snapshots. progress: called with (done, total) parts. until: position (a) of the feature; the worst points of the moments up
    to there are told, too ("resolved" of the summary).
    On the rows of the reader (where they begin with y = 0, the others are its mirror). Memory: one block of histories
    (1 GB at most), with thermal stress 8 bytes more per entry and wave number (4 nodes of the grid).
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
    progress, early, wanted = Told.of(progress, scene, passage), _early(passage, until), bool(scene.fatigue.depths)
    layers = [layer(scene, passage, depth, progress, early) for depth in (0.0, *scene.fatigue.listed)]
    deep = depth_search.search(scene, passage, layers, early, progress) if wanted else depth_search.Deep([], [])
    progress.end()
    result = _result(scene, passage, layers, deep)
    if early is not None:
        points = [found.early for found in layers[1:]] + deep.early
        result.summary["resolved"] = _resolved(until, layers[0].early, points, scene.fatigue.endurance)
    return result


def _early(passage, until):
    """Moments with the feature up to `until` (a) and the unloaded one; None where nobody asks, or these are all or none."""
    if until is None:
        return None
    first = np.flatnonzero(passage.centres <= (until + 1e-9) * passage.a)
    return np.append(first, passage.centres.size) if 1 < first.size < passage.centres.size else None


def _resolved(until, top, deep, limit):
    """Summary of the worst points (of the surface, of those below) of the moments up to `until`."""
    out = {"to_x_a": float(until), **top.summary(limit)}
    worst = max(deep, key=lambda point: point.f, default=None)
    return out if worst is None else out | {"below": {"depth_m": worst.depth, **worst.summary(limit)}}


def _result(scene, passage, layers, below):
    surface, limit, centres = layers[0], scene.fatigue.endurance, passage.centres
    summary = {**surface.worst.summary(limit), "sigma1_max_Pa": float(surface.sigma1.max()),
               "kappa_F": float(scene.fatigue.kappa), "sigma_eF_Pa": float(limit), **surface.worst.moments(centres),
               "criterion": scene.fatigue.criterion, "thermal_stress": scene.thermal_stress_wanted,
               "pit_angles_deg": list(PIT_ANGLES)}
    maps, worst, deep = _maps(surface, passage, limit), surface.worst.history(centres), None
    maps |= _history_maps(worst, "worst", "the worst point of the surface")
    points = [found.worst for found in layers[1:]] + below.worst
    if points:
        point = max(points, key=lambda point: point.f)
        summary["below"], deep = {"depth_m": point.depth, **point.summary(limit)}, point.history(centres)
        maps |= _history_maps(deep, "worst_below", "the worst point below it")
    if below.profiles:
        depths = below.profiles[0].depths
        summary["below"] |= {"searched_m": [float(depths[0]), float(depths[-1])], **_alone(below.profiles, limit)}
        rungs = ROW_DEPTH if len(layers) > 1 else DEPTH
        maps |= _profile_maps(surface, passage, below.profiles, rungs) | _plane_maps(below.plane)
    if len(layers) > 1:
        summary["by_depth"] = [{"depth_m": layer.depth, "findley_stress_max_Pa": float(layer.f.max()),
                                "sigma1_max_Pa": float(layer.sigma1.max())} for layer in layers]
        maps |= _layer_maps(layers)
    return FatigueResult(summary, maps, worst, deep)


def _alone(profiles, limit):
    """What the contact has below it without its feature, where that was looked for."""
    for profile in profiles:
        if profile.alone:
            f = profile.worst.f
            return {"contact_alone": {"Fi_max": f / limit, "findley_stress_max_Pa": f, "depth_m": profile.worst.depth}}
    return {}


def _history_maps(history, name, of):
    """The history of a worst point as a store keeps it."""
    return {f"{name}_x_a": (history["x_a"], ["moment"], "m", "centre of the feature; the last moment is unloaded"),
            f"{name}_stress": (history["stress"], ["moment", "component"], "Pa", f"xx, yy, zz, xy, xz, yz at {of}"),
            f"{name}_normal": (history["normal"], ["direction"], "1", "unit normal of its critical plane"),
            f"{name}_circle": (history["circle"], ["of_circle"], "Pa",
                               "around its shear path: centre along dip, strike; radius")}


BOTH = ["feature_frame_x", "feature_frame_y"]
DEPTH, ROW_DEPTH = "fatigue_depth", "under_row_depth"  # the depths searched; those under a row, where others are listed


def _maps(surface, passage, limit):
    """Of the surface."""
    return {BOTH[0]: (passage.x, BOTH[:1], "m", "along rolling, from the centre of the feature"),
            BOTH[1]: (passage.y, BOTH[1:], "m", "across, from the centre of the contact"),
            "findley_stress": (surface.f, BOTH, "Pa", "Findley stress"), "Fi": (surface.f / limit, BOTH, "1", "Findley index"),
            "sigma1_max": (surface.sigma1, BOTH, "Pa", "largest principal stress of the passage"),
            "plane_theta": (surface.theta, BOTH, "degree", "angle of the critical plane's normal from the surface normal"),
            "plane_phi": (surface.phi, BOTH, "degree", "direction of the critical plane's normal in the surface, from x")}


def _plane_maps(plane):
    """Of the plane below that was searched at all its points."""
    if plane is None:
        return {}
    return {"worst_depth": (np.array([plane.depth]), ["worst_depth"], "m", "below the surface, searched at all points"),
            "findley_stress_at_worst_depth": (plane.f, BOTH, "Pa", "Findley stress at that depth")}


def _layer_maps(layers):
    """Of all points at every depth asked for."""
    return {DEPTH: (np.array([layer.depth for layer in layers]), [DEPTH], "m", "below the surface"),
            "findley_stress_at_depth": (np.stack([layer.f for layer in layers]), [DEPTH, *BOTH], "Pa", "Findley stress")}


def _profile_maps(surface, passage, profiles, depth):
    """Over the dimension `depth`, the surface first: under the row with the worst point, and of the contact alone."""
    under = max((profile for profile in profiles if not profile.alone), key=lambda profile: profile.worst.f)
    row = surface.f[:, [int(np.argmin(np.abs(passage.y - under.worst.y)))]].T
    out = {depth: (np.append(0.0, under.depths), [depth], "m", "below the surface"),
           "findley_stress_under_row": (np.concatenate([row, under.f]), [depth, BOTH[0]], "Pa",
                                        "Findley stress under the row of the worst point below the surface")}
    for profile in profiles:
        if profile.alone:
            out["findley_stress_contact_alone"] = (np.append(np.nan, profile.f.max(axis=1)), [depth], "Pa",
                                                   "Findley stress of the contact without its feature")
    return out
