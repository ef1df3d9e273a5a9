"""Numbers that decide a verdict: at and below the surface, of the whole passage or of its resolved part."""

from dataclasses import dataclass

from tehl_taichi.fatigue.pressure_alone import searched
from tehl_taichi.values.digits import micrometres
from tehl_taichi.values.summary_values import error_of

ABOVE, WITHIN, BELOW = 1, 0, -1


@dataclass(frozen=True)
class JudgedPoint:
    """A point at or below a surface whose index counts. where: text of its place; part: of a summary, with the index under
    `key`; surface: its name, None if unknown; length: over which its stresses are averaged, m, else 0.
    """

    where: str
    part: dict
    key: str
    surface: str | None = None
    length: float = 0.0

    @property
    def Fi(self):
        return self.part[self.key]

    @property
    def error(self):
        return error_of(self.part, self.key)

    @property
    def depth(self):
        """Below the surface, m."""
        return self.part.get("depth_m", 0.0)

    @property
    def rank(self):
        """Order in which points decide."""
        return order(self.Fi, self.error)

    @property
    def layer(self):
        """(where, Fi, its error or None)."""
        return self.where, self.Fi, self.error


def judged(Fi, error=None):
    """State of an index: above 1, below it, or 1 within its error (None: unknown)."""
    if abs(Fi - 1) <= (error or 0.0):
        return WITHIN
    return ABOVE if Fi > 1 else BELOW


def standing(Fi, error):
    """Order in which indices decide, before their size: by state; above 1 those with a known error, because one is enough."""
    state = judged(Fi, error)
    return state, state == ABOVE and error is not None


def order(Fi, error):
    """Order in which indices decide: by :func:`standing`, then by their size."""
    return standing(Fi, error), Fi


def deciding(searches):
    """({surface: summary that decides}, whether they are of the resolved part) of {surface: summary of its search}.

    If the grid does not resolve every pressure, the part of the passage before that decides, unless averaged stresses settle
    the answer.
    """
    found = {name: searched(one) for name, one in searches.items()}
    if not any(one.get("rough") for one in found.values()) and all("resolved" in one for one in found.values()) \
            and not _settled(searches):
        return {name: one["resolved"] for name, one in found.items()}, True
    return searches, False


def judged_point(searches):
    """The :class:`JudgedPoint` whose index decides the verdict on {surface: summary of its search}: the worst."""
    return max(judged_points(deciding(searches)[0]), key=lambda point: point.rank)


def first_decides(searches):
    """Searches {surface: summary}, the body that decides the verdict first."""
    first = judged_point(searches).surface
    return {first: searches[first], **searches}


def worst_layer(searches):
    """The :func:`layers` entry that decides the verdict."""
    return judged_point(searches).layer


def deciding_point(searches):
    """(text of the place, part) of the point that decides; of rough surfaces, whose percentile has no place, the worst one."""
    found = deciding(searches)[0]
    worst = max((point for name, one in found.items() for point in _points(searched(one), _text(name, found), name)),
                key=lambda point: point.rank)
    return worst.where, worst.part


def _settled(searches):
    """Whether averaged stresses give the errors that the pointwise ones lack, for all deciding numbers."""
    averaged = any(length for one in searches.values() for _, length in leading(searched(one)))
    return averaged and all(error is not None for *_, error in all_layers(searches))


def all_layers(searches):
    """[(text of the place, Fi, its error or None)] at and below each surface, of {surface: summary of its search}; with two
    surfaces the texts name them.
    """
    return [point.layer for point in judged_points(searches)]


def judged_points(searches):
    """[:class:`JudgedPoint`] at and below each surface, of {surface: summary of its search}; with two the texts name them. For
    rough surfaces the index is the 99th percentile.
    """
    return [point for name, found in searches.items() for point in _judged(searched(found), _text(name, searches), name)]


def _text(name, searches):
    return "the surface" if len(searches) == 1 else f"surface {name}"


def _judged(fatigue, surface, name):
    return (_percentiles if fatigue.get("rough") else _points)(fatigue, surface, name)


def _points(fatigue, surface, name):
    """[JudgedPoint] at and below the surface."""
    return [JudgedPoint(f"{_where(part, surface)}{over(length)}", part, "Fi_max", name, length)
            for part, length in leading(fatigue)]


def leading(found):
    """Parts of a search's summary at and below the surface: [(part, length (m) over which its stresses are averaged, or 0)];
    the averaged part if only its error is known.
    """
    wide = found.get("averaged", {})
    pairs = [(found, wide), (found.get("below"), wide.get("below"))]
    return [(own, 0.0) if not _alone_known(own, other) else (other, wide["length_m"]) for own, other in pairs if own]


def _alone_known(own, other):
    """Whether the error of the averaged index is known and that of the pointwise one is not."""
    errors = [error_of(part, "Fi_max") for part in (own, other)]
    return errors[0] is None and errors[1] is not None


def _where(part, surface):
    return f"{micrometres(part['depth_m'])} µm below {surface}" if "depth_m" in part else f"at {surface}"


def over(length, um="µm"):
    """Text after a place whose stresses are averaged over `length` (m); "" for length 0."""
    return f" (stresses averaged over {micrometres(length)} {um})" if length else ""


def _percentiles(fatigue, surface, name):
    both = fatigue["statistics"], fatigue.get("below", {}).get("statistics")
    return [JudgedPoint(_where(part, surface), part, "p99", name) for part in both if part]
