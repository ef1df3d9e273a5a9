"""Numbers that decide a verdict: at and below the surface, of the whole passage or of its resolved part."""

from tehl_taichi.fatigue import material_length
from tehl_taichi.fatigue.pressure_alone import searched
from tehl_taichi.values.digits import micrometres

ABOVE, WITHIN, BELOW = 1, 0, -1


def judged(Fi, error=None):
    """State of an index: above 1, below it, or 1 within its error (None: unknown)."""
    if abs(Fi - 1) <= (error or 0.0):
        return WITHIN
    return ABOVE if Fi > 1 else BELOW


def standing(Fi, error):
    """Order in which indices decide, before their size: by state; above 1 those with a known error, because one is enough."""
    state = judged(Fi, error)
    return state, state == ABOVE and error is not None


def deciding(searches):
    """({surface: summary that decides}, whether they are of the resolved part) of {surface: summary of its search}.

    If the grid does not resolve every pressure, the part of the passage before that decides, unless averaged stresses settle
    the answer.
    """
    if any(searched(one).get("rough") for one in searches.values()):
        return searches, False
    if all("resolved" in one for one in searches.values()) and not _settled(searches):
        return {name: one["resolved"] for name, one in searches.items()}, True
    return searches, False


def worst_layer(searches):
    """The :func:`layers` entry that decides the verdict on {surface: summary of its search}: the worst."""
    return max(all_layers(deciding(searches)[0]), key=lambda one: (standing(*one[1:]), one[1]))


def deciding_point(searches):
    """(text of the place, part) of the point that decides; of rough surfaces, whose percentile has no place, the worst one."""
    points = [point for surface, found in _named(deciding(searches)[0]) for point in _points(searched(found), surface)]
    return max(points, key=lambda one: (standing(one[1]["Fi_max"], error_of(one[1], "Fi_max")), one[1]["Fi_max"]))


def _settled(searches):
    """Whether averaged stresses give the errors that the pointwise ones lack, for all deciding numbers."""
    averaged = any(length for one in searches.values() for _, length in material_length.leading(searched(one)))
    return averaged and all(error is not None for *_, error in all_layers(searches))


def all_layers(searches):
    """The :func:`layers` of each {surface: summary of its search}; with two surfaces the texts name them."""
    return [layer for surface, found in _named(searches) for layer in layers(found, surface)]


def _named(searches):
    """[(text of the surface, summary of its search)]."""
    return [("the surface" if len(searches) == 1 else f"surface {name}", found) for name, found in searches.items()]


def layers(fatigue, surface="the surface"):
    """[(text of the place, Fi, its error or None)] at and below the surface, of a search or its part. For rough surfaces Fi is
    the 99th percentile.
    """
    fatigue = searched(fatigue)
    if fatigue.get("rough"):
        return _percentile_layers(fatigue, surface)
    return [(where, part["Fi_max"], error_of(part, "Fi_max")) for where, part in _points(fatigue, surface)]


def _points(fatigue, surface):
    """[(text of the place, part)] at and below the surface."""
    return [(f"{_where(part, surface)}{_over(length)}", part) for part, length in material_length.leading(fatigue)]


def _where(part, surface):
    return f"{micrometres(part['depth_m'])} µm below {surface}" if "depth_m" in part else f"at {surface}"


def _over(length):
    """Text after a place whose stresses are averaged over `length` (m); "" for length 0."""
    return f" (stresses averaged over {micrometres(length)} µm)" if length else ""


def _percentile_layers(fatigue, surface):
    top, deep = fatigue["statistics"], fatigue.get("below", {}).get("statistics")
    found = [(f"at {surface}", top["p99"], error_of(top, "p99"))]
    if deep:
        found.append((f"{micrometres(deep['depth_m'])} µm below {surface}", deep["p99"], error_of(deep, "p99")))
    return found


def error_of(part, key):
    """Error bar of a number of a part, None if it is unknown."""
    return part.get("error", {}).get(key)
