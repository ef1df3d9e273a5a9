"""Answer for a sequence of contacts: the place whose index decides, and those whose error bars overlap with it."""

from dataclasses import dataclass
from functools import cached_property

from tehl_taichi.fatigue.judged_layers import ABOVE, BELOW, WITHIN, all_layers, deciding, judged, order, worst_layer
from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.fatigue.pressure_alone import searched, why_none
from tehl_taichi.report.number_text import FEW, index, value_text
from tehl_taichi.report.verdict import LATER, headline, state_and_index, with_load
from tehl_taichi.values.digits import micrometres, part_of
from tehl_taichi.values.summary_values import error_of

UNKNOWN_LATER = "Probably not: the index stays below 1, but over the whole passage its error is unknown."


@dataclass(frozen=True)
class JudgedPlace:
    """A place with an index. number: along the path; name, words: short and full text; searches: {surface: summary of a
    search}.
    """

    number: int
    name: str
    words: str
    searches: dict

    @property
    def early(self):
        """Whether the resolved part of the passage decides."""
        return deciding(self.searches)[1]

    @cached_property
    def layer(self):
        """(where, Fi, its error or None) of the worst layer, which decides."""
        return worst_layer(self.searches)

    @property
    def Fi(self):
        return self.layer[1]

    @property
    def error(self):
        return self.layer[2]

    @property
    def state(self):
        return judged(self.Fi, self.error)

    @property
    def where(self):
        """Text of the worst layer and the place."""
        return f"{self.layer[0]} at {self.words}"

    @cached_property
    def whole(self):
        """(where, Fi, error) of the largest index of the whole passage."""
        return max(all_layers(self.searches), key=lambda one: one[1])

    @property
    def rough(self):
        return any(searched(one).get("rough") for one in self.searches.values())


def judged_places(rows, name, words):
    """List of :class:`JudgedPlace` along the path. rows: (position, Hertz pressure, summary or None); name, words: functions of
    a position.
    """
    return [JudgedPlace(n, name(at), words(at), by_surface(summary)) for n, (at, _, summary) in enumerate(rows)
            if (summary or {}).get("fatigue") and not why_none(summary["fatigue"])]


def worst(places):
    """The :class:`JudgedPlace` that decides."""
    return max(places, key=lambda place: order(place.Fi, place.error))


def overlapping_places(places):
    """The worst place and those whose error bars overlap with its bar, along the path."""
    top = worst(places)
    return [place for place in places if place is top or _overlap(place, top)]


def _overlap(place, top):
    return None not in (place.error, top.error) and abs(top.Fi - place.Fi) <= place.error + top.error


def answer(places, count):
    """(headline, tone, sentences); places: not empty; count: of all positions."""
    top, group = worst(places), overlapping_places(places)
    _, alone = max(_smooth(places), key=state_and_index, default=(None, None))
    text, tone = with_load(_headline(places, top, group), alone)
    return text, tone, _sentences(places, top, group, count)


def _headline(places, top, group):
    if top.state == BELOW and any(place.early for place in places):
        later = [place for place in places if place.early and judged(*place.whole[1:]) != BELOW]
        if not later:
            return UNKNOWN_LATER, "no"
        return f"{LATER[max(judged(*place.whole[1:]) for place in later)]} {_among(later, places)}.", "open"
    where = top.where if len(group) == 1 else f"{_among(group, places)}, where the errors do not separate the positions"
    even = "even " if top.state == ABOVE else ""
    when = f", {even}without the pressures that the grid does not resolve" if top.early else ""
    return headline(top.state, where, top.error is not None, when)


def _among(group, places):
    """Text such as 'between A and C' for neighbours, 'at A and E' for others."""
    neighbours = [places.index(place) for place in group]
    if len(group) > 2 and neighbours == list(range(neighbours[0], neighbours[-1] + 1)):
        return f"between {group[0].name} and {group[-1].name}"
    return f"at {_listed([place.name for place in group])}"


def _listed(words):
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1])))


def _sentences(places, top, group, count):
    what = "99th percentile of the index" if top.rough else "index"
    others = [place.name for place in group if place is not top]
    apart = f"; its error does not separate it from {_listed(others)}" if others else ""
    above, within = (sum(place.state == state for place in places) for state in (ABOVE, WITHIN))
    doubtful = f"; 1 lies within the error at {within} more" if within else ""
    decides = f"The {what} that decides is Fi = {index(top.Fi, top.error)}, {top.where}{apart}."
    return (*_alone(places), decides, *_whole(places), f"It is above 1 at {part_of(above, count, 'position')}{doubtful}.")


def _whole(places):
    """Sentence about the largest index of moments whose pressure the grid does not resolve."""
    if not (early := [place for place in places if place.early]):
        return ()
    top = max(early, key=lambda place: place.whole[1])
    where, Fi, error = top.whole
    unknown = " (error unknown)" if error is None else ""
    names = _listed([place.name for place in early])
    return (f"At {names} the grid does not resolve the pressure of the whole passage: over it the largest index there is Fi = "
            f"{index(Fi, error)}{unknown}, {where} at {top.words}.",)


def _smooth(places):
    """[(place, numbers of its smooth contact)] of both bodies."""
    return [(place, part) for place in places for one in place.searches.values()
            if (part := searched(one).get("contact_alone"))]


def _alone(places):
    """Sentence about the load limit of the smooth contacts."""
    if not (found := _smooth(places)):
        return ()
    place, alone = max(found, key=lambda one: one[1]["Fi_max"])
    depth = f"{micrometres(alone['depth_m'])} µm below the surface" if alone["depth_m"] else "at the surface"
    return (f"The smooth contacts alone: Fi = {index(alone['Fi_max'], error_of(alone, 'Fi_max'))} at most, {depth} at "
            f"{place.words}.",)


def of_smooth_contacts(rows, name, words):
    """Sentence about the index of steady contacts, over which no feature passes; () without one. Arguments: as in
    :func:`judged_places`.
    """
    alone = [((summary or {}).get("contact_alone_by_surface", {}), at) for at, _, summary in rows]
    return _alone([JudgedPlace(n, name(at), words(at), {surface: {"contact_alone": part} for surface, part in found.items()})
                   for n, (found, at) in enumerate(alone)])


def thinnest(rows):
    """(text of the smallest steady film with its error, its place); None without results. rows: (place, Hertz pressure, summary
    or None).
    """
    found = [(summary["steady"]["h_min_m"], error_of(summary, "steady", "h_min_m"), at) for at, _, summary in rows if summary]
    if not found:
        return None
    film, error, at = min(found, key=lambda entry: entry[0])
    return value_text(film, error, "m", FEW) + " (error unknown)" * (error is None), at
