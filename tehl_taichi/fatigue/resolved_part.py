"""Search of the early moments, while the grid resolves the pressure; the verdict rests on them."""

from tehl_taichi.fatigue import local_strength, result_arrays
from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.fatigue.worst_point import worst_of


def part(passage, early, until, layers, deep):
    """The SearchResult of the moments `early` of a passage, up to the position `until` (a): "to_x_a" of its summary.

    layers: at the listed depths, the surface first, each with its `early`; deep:
    :class:`tehl_taichi.fatigue.depth_search.DepthResult`.
    """
    limit, centres = passage.strength.surface_limit, passage.positions[early[:-1]]
    top, points = layers[0].early, [found.early.worst for found in layers[1:]] + deep.early
    summary = {"to_x_a": float(until), **top.worst.summary()}
    arrays = {"Fi": top.f / limit, "worst": top.worst.history(centres), **_below(passage, layers, deep)}
    if points:
        worst = worst_of(points)
        summary["below"] = local_strength.summary(passage, worst)
        arrays["worst_below"] = worst.history(centres)
    return SearchResult(summary, **arrays)


def _below(passage, layers, deep):
    """Arrays below the surface; depths and the contact alone are those of the whole passage."""
    arrays = {}
    if deep.before:
        arrays["findley_stress_under_row"] = result_arrays.under_row(layers[0].early.f, passage, deep.before)
    if deep.early_plane:
        arrays |= result_arrays.of_plane(deep.early_plane, passage.strength)
    if len(layers) > 1:
        arrays["findley_stress_at_depth"] = result_arrays.at_depths([found.early for found in layers])
    return arrays
