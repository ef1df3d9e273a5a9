"""Fatigue of the material around a feature: stress histories, critical planes, the index."""

from dataclasses import replace
from types import MappingProxyType

import numpy as np

from tehl_taichi.fatigue import (
    contact_alone,
    every_moment,
    index_statistics,
    local_strength,
    material_length,
    resolved_part,
    result_arrays,
    stress_cycles,
    stressed_volume,
    von_mises,
)
from tehl_taichi.fatigue.averaged_surface import AveragedSurface
from tehl_taichi.fatigue.judged_surfaces import resting
from tehl_taichi.fatigue.layer import layer
from tehl_taichi.fatigue.pass_progress import PassProgress
from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.fatigue.sought import Sought
from tehl_taichi.fatigue.stress.histories import StressHistories
from tehl_taichi.fatigue.worst_point import worst_of
from tehl_taichi.scene import SceneError, fatigue_limits, rough_surfaces
from tehl_taichi.values.units import amount

NO_BOXES = MappingProxyType({})  # all points are searched
PIT_ANGLES = (18.0, 50.0)  # degrees to the surface at which pits begin (Everitt 2018)


class Snapshots:
    """Reader of a list of snapshots on one grid, as :func:`run` takes it.

    residual_fields: {surface name: ResidualField}.
    """

    def __init__(self, snapshots, residual_fields=None):
        self.items = list(snapshots)
        self.x, self.y = self.items[0].x, self.items[0].y
        self.time = np.array([s.time for s in self.items])
        self.residual_fields = residual_fields or {}

    def __len__(self):
        return len(self.items)

    def feature_x(self, n):
        """Centre of the feature (m) at entry n."""
        return self.items[n].feature_x

    def fields(self, n, names):
        """{name: (nx+1, ny+1) array} of entry n."""
        return {name: self.items[n].fields[name] for name in names}

    def scalar(self, name):
        """Values of a number, one per entry."""
        return np.array([s.scalars[name] for s in self.items])


def run(scene, reader, progress=None, until=None, alone=True, sought=Sought.ALL, boxes=NO_BOXES):
    """Search the fatigue of a passage; return the SearchResult of the body that decides, with the other body's result in it.

    The bodies are those of `scene.judged`. The points lie within 0.6 a of the first feature (0.3 a beyond the rim of larger
    features) and where features slide over the surface. The criterion and the moments (from_x to to_x) are those of
    `scene.fatigue`. Searched are all points of the surface, all points of the depths that `scene.fatigue.depths` lists and,
    unless it is empty, the depths under single rows (:mod:`tehl_taichi.fatigue.depth_search`). Rows that begin with y = 0 are
    mirrored.

    reader: a list of snapshots, or a reader as :class:`tehl_taichi.fatigue.stress.histories.StressHistories` describes it.
    progress: called with (done, total) parts. until: position (a) of the feature; the worst points of the moments up to there
    are also reported ("resolved" of the summary). alone: whether the smooth contact is searched, too. sought, boxes: which
    points are searched (:mod:`tehl_taichi.fatigue.sought`); boxes: {surface name: Box}, all points of a surface without one.
    Memory: one block of histories (at most 1 GB); thermal stress needs 8 bytes more per entry and wave number (one wave number
    per 4 nodes of the grid). Raises SceneError if no feature passes.
    """
    until = None if until is None else amount("until", until, "a", infinite=True)
    reader = Snapshots(reader) if isinstance(reader, (list, tuple)) else reader
    centres = np.array([reader.feature_x(n) for n in range(len(reader))])
    if len(reader) < 2 or not np.isfinite(centres).all():
        raise SceneError("fatigue needs the passage of a feature: a scene with a feature and at least one time step")
    if not (count := len(scene.judged)):
        raise resting(scene.fatigue.surfaces)
    wide = material_length.counts(scene, reader.x)
    total = count * (1 + wide)
    passages = [StressHistories(scene, reader, centres, surface=surface, box=boxes.get(surface.name), sought=sought)
                for surface in scene.judged]
    averages = [AveragedSurface(passage, scene.fatigue.length) if wide else None for passage in passages]
    results = [_of_surface(scene, passage, centres, _share(progress, n, total), until, alone, one)
               for n, (passage, one) in enumerate(zip(passages, averages))]
    if wide:
        results = [_with_length(one, passage, top.layer, centres, boxes, _share(progress, count + n, total))
                   for n, (one, passage, top) in enumerate(zip(results, passages, averages))]
    return SearchResult.joined(results).decided()


def _with_length(result, passage, top, centres, boxes, progress):
    """The result with the index of stresses averaged over fatigue.length; top: their Layer at the surface."""
    found = material_length.part(passage, top, centres, boxes.get(passage.surface.name), progress)
    return replace(result, summary={**result.summary, "averaged": found})


def _share(progress, n, count):
    """Progress function of the search on the n-th of `count` surfaces, called with its (done, total)."""
    return progress and (lambda done, total: progress(n * total + done, count * total))


def _of_surface(scene, passage, centres, progress, until, alone, averages):
    """SearchResult of one body; averages: see :func:`layer`. Raises SceneError if fewer than two stored moments count."""
    if passage.centres.size < 2:
        f = scene.fatigue
        raise SceneError(f"no stored moment has the feature between fatigue.from_x = {f.from_x:g} a and to_x = {f.to_x:g} a; "
                         f"it moves from {centres[0] / passage.a:.2f} to {centres[-1] / passage.a:.2f} a")
    early = _early(passage, until)
    progress = PassProgress.of(progress, scene, passage, early)
    top = layer(scene, passage, 0.0, progress, early, averages)
    layers, deep = every_moment.searched(scene, passage, top, early, progress)
    smooth = contact_alone.search(scene, passage.reader, passage.surface) if alone else None
    result = _result(scene, passage, layers, deep, smooth)
    if stressed := _stressed(scene, passage, layers[0], smooth):
        result = replace(result, summary={**result.summary, "stressed": stressed})
    if early is None:
        return result
    part = resolved_part.part(passage, early, until, layers, deep)
    return replace(result, summary={**result.summary, "resolved": part.summary}, resolved=part)


def _stressed(scene, passage, surface, alone):
    """{name: number} of the stressed volume and surface; {} if the scene has no Weibull exponent, or the smooth contact was not
    searched below the surface."""
    f = scene.fatigue
    if not f.weibull or not alone or not f.depths:
        return {}
    found = stressed_volume.part(passage, surface.f, alone)
    return {**found, **stressed_volume.probabilities(found, f.reference_volume, f.reference_area)}


def _early(passage, until):
    """Numbers of the moments with the feature up to `until` (a), and of the unloaded one.

    None if `until` is None, or if these are all moments or fewer than two.
    """
    if until is None:
        return None
    first = np.flatnonzero(passage.positions <= (until + 1e-9) * passage.a)
    return np.append(first, passage.positions.size) if 1 < first.size < passage.positions.size else None


def _result(scene, passage, layers, below, alone):
    """SearchResult of one body from its layers (the surface first), its DepthResult and its smooth contact (or None)."""
    surface, centres, counts = layers[0], passage.positions, index_statistics.weights(passage)
    arrays = {**result_arrays.of_surface(surface, passage, passage.strength.surface_limit, counts),
              "worst": surface.worst.history(centres)}
    summary = _surface_numbers(scene, passage, surface, alone, counts)
    peaks = [found.mises for found in layers] + below.mises
    summary["von_mises"] = von_mises.summary(peaks, surface.mises.value, passage.surface, passage.strength)
    if points := [found.worst for found in layers[1:]] + below.worst:
        point = worst_of(points)
        summary["below"] = {**local_strength.summary(passage, point), **_cycles(point, point.local),
                            **_depth_numbers(passage, below, counts)}
        arrays |= {"worst_below": point.history(centres), **_depth_arrays(passage, layers, below, alone)}
    if len(layers) > 1:
        summary["by_depth"] = [{"depth_m": layer.depth, "findley_stress_max_Pa": float(layer.f.max()),
                                "sigma1_max_Pa": float(layer.sigma1.max())} for layer in layers]
        arrays |= result_arrays.of_layers(layers, passage.strength)
    return SearchResult(summary, **arrays)


def _surface_numbers(scene, passage, surface, alone, counts):
    """Numbers of the surface of one body, with the constants and the smooth contact; counts: weights of its points."""
    local, limit = passage.strength.at(0.0), passage.strength.surface_limit
    statistics = {} if passage.sought is Sought.WORST else {"statistics": _statistics(surface, counts, limit)}
    return {"surface": passage.surface.name, "carries_feature": bool(passage.surface.features),
            "rough": rough_surfaces.is_rough(scene),
            **surface.worst.summary(), "sigma1_max_Pa": float(surface.sigma1.max()),
            "kappa_F": float(local.kappa), "sigma_eF_Pa": float(limit), **_limits(scene.fatigue, passage.strength),
            **_cut(scene.fatigue), **surface.worst.moments(passage.positions),
            "criterion": scene.fatigue.criterion, "thermal_stress": scene.has_thermal_stress,
            "pit_angles_deg": list(PIT_ANGLES), **({"contact_alone": alone.summary} if alone else {}),
            **_cycles(surface.worst, local), **statistics}


def _cycles(point, local):
    return {"cycles_above_1": stress_cycles.above(point.stress, point.normal, local)}


def _depth_numbers(passage, below, counts):
    """Numbers of the searched depths; {} if none were searched."""
    if not below.profiles:
        return {}
    depths = below.profiles[0].depths
    statistics = {"statistics": _statistics_below(below, counts, passage)} if index_statistics.has_below(passage) else {}
    return {"searched_m": [float(depths[0]), float(depths[-1])], **statistics}


def _depth_arrays(passage, layers, below, alone):
    """Arrays over the searched depths; {} if none were searched."""
    if not below.profiles:
        return {}
    return {**result_arrays.of_profiles(layers[0].f, passage, below.profiles, len(layers) > 1),
            **({"findley_stress_contact_alone": alone.f} if alone else {}),
            **(result_arrays.of_plane(below.plane, passage.strength) if below.plane else {})}


def _statistics(layer, counts, limit):
    """Index statistics of a layer, with the mean number of cycles above the limit (Pa), if they were counted; counts: weights
    of its points.
    """
    cycles = {"cycles_above_1": float(np.nanmean(layer.cycles))} if np.isfinite(layer.cycles).any() else {}
    return {**index_statistics.statistics(layer.f / limit, counts), **cycles}


def _statistics_below(below, counts, passage):
    """Statistics of the points under the searched rows, at the depth with the largest 99th percentile, and "by_depth".

    "plane": statistics of the depth that was searched at all its points, if one was.
    """
    found = index_statistics.below(passage, below.profiles, counts)
    if below.plane:
        found["plane"] = {"depth_m": below.plane.depth,
                          **_statistics(below.plane, counts, passage.strength.at(below.plane.depth).endurance)}
    return found


def _cut(fatigue):
    """{name: position of the feature (a)} between which moments count; {} if all count."""
    ends = {"from_x_a": fatigue.from_x, "to_x_a": fatigue.to_x}
    return {key: float(x) for key, x in ends.items() if np.isfinite(x)}


def _limits(fatigue, strength):
    """{name: limit (Pa)} from which the constants follow; {} if the constants or a table were given."""
    if strength.table is not None:
        return {}
    return {f"{key}_Pa": float(getattr(fatigue, key)) for key in fatigue_limits.given_limits(vars(fatigue))}
