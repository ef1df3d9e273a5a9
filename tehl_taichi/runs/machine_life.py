"""Machine hours to crack initiation: number of passages over passages per hour."""

import math
from dataclasses import dataclass

from tehl_taichi.fatigue.judged_surfaces import by_surface

HOUR = 3600.0  # s


@dataclass(frozen=True)
class ContactRates:
    """Contacts per hour. each: {surface: contacts of one of its points}; pair: contacts of a point with the same point (and
    feature) of the other body, None: at random.
    """

    each: dict
    pair: float | None = None

    def of(self, life, searches):
        """Passages per hour at the worst point of a part "life"; None if they are random.

        searches: {surface: summary of its search}. Rough surfaces and the body with the features have one passage in each
        contact.
        """
        own = searches[life["surface"]]
        return self.each[life["surface"]] if own.get("rough") or own.get("carries_feature") else self.pair


def of_gears(n1, z1, z2, on):
    """ContactRates of a gear pair with z1 teeth on the pinion, which turns n1 times a minute, and z2 on the gear; `on` names
    the gear whose tooth is body a. Two teeth meet again after the least common multiple of both numbers.
    """
    meshes = 60 * n1 * z1
    a, b = (z1, z2) if on == "pinion" else (z2, z1)
    return ContactRates({"a": meshes / a, "b": meshes / b}, meshes / math.lcm(a, b))


def of_ring(bearing, ring):
    """ContactRates of a ring (body a) with its elements, from the records of ring and bearing; a point of an element touches
    both rings in turn.
    """
    return ContactRates({"a": HOUR * ring["passes_per_s"], "b": HOUR * bearing["element_passes_per_s"] / 2})


def with_hours(summary, rates):
    """Summary with `hours` and their error in its part "life", if it has that part and rates (ContactRates) are known."""
    if not (rates and summary and "life" in summary):
        return summary
    life = summary["life"]
    if not (often := rates.of(life, by_surface(summary))):
        return summary
    error = life["error"]["passages"]
    errors = {**life["error"], "hours": None if error is None else error / often}
    return {**summary, "life": {**life, "hours": life["passages"] / often, "error": errors}}
