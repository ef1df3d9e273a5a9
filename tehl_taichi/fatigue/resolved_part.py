"""What a search knows of the early moments, before the grid no longer resolves the pressure: the answer rests on them."""

from dataclasses import dataclass

from tehl_taichi.fatigue import result_maps

NAME = "resolved_"  # begins the names of their maps: they are those of the whole passage, of fewer moments
SAID = " while the grid resolves the pressure"
SHARED = (result_maps.DEPTH, result_maps.ROW_DEPTH, result_maps.ALONE)
OWN = ("moment", "worst_depth")  # dimensions that are not those of the whole passage


@dataclass(frozen=True)
class Resolved:
    """summary: numbers in SI of the worst point of the surface, of that below in its "below", and the last position of the
    feature, to_x_a (a); maps: as of :class:`tehl_taichi.fatigue.assessment.FatigueResult`."""

    summary: dict
    maps: dict


def part(scene, passage, early, until, layers, deep):
    """The Resolved of the moments `early` of a passage, up to the position `until` (a); layers: at the depths asked for, the
    surface first, each with its `early`; deep: :class:`tehl_taichi.fatigue.depth_search.DepthResult`."""
    limit, centres = scene.fatigue.endurance, passage.centres[early[:-1]]
    top, points = layers[0].early, [found.early.worst for found in layers[1:]] + deep.early
    maps, summary = {"Fi": result_maps.index(top.f, limit)}, {"to_x_a": float(until), **top.worst.summary(limit)}
    maps |= result_maps.of_history(top.worst.history(centres), "worst", "the critical point at the surface")
    if points:
        worst = max(points, key=lambda point: point.f)
        summary["below"] = {"depth_m": worst.depth, **worst.summary(limit)}
        maps |= result_maps.of_history(worst.history(centres), "worst_below", "the critical point below the surface")
    return Resolved(summary, _named(maps | _below(passage, layers, deep)))


def _below(passage, layers, deep):
    """Maps of what lies below the surface."""
    maps, listed = {}, len(layers) > 1
    if deep.before:
        maps |= result_maps.of_profiles(layers[0].early.f, passage, deep.before, listed)
    if deep.early_plane:
        maps |= result_maps.of_plane(deep.early_plane)
    if listed:
        maps |= result_maps.of_layers([found.early for found in layers])
    return maps


def _named(maps):
    """The same with names of their own; depths that were searched, and the contact alone, are those of the whole passage."""
    return {NAME + name: (values, [NAME + dim if dim in OWN else dim for dim in dims], units, text + SAID)
            for name, (values, dims, units, text) in maps.items() if name not in SHARED}
