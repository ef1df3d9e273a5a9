"""Hours of a machine to the initiation of a crack: passages over the number of them in an hour."""

import math
from dataclasses import dataclass

from tehl_taichi.fatigue.judged_surfaces import by_surface

HOUR = 3600.0  # s


@dataclass(frozen=True)
class ContactRates:
    """Per hour: each {surface: contacts of one of its points}; pair: how often a point meets one of the other body again, and
    a feature there; None: at random."""

    each: dict
    pair: float | None = None

    def of(self, life, searches):
        """Passages in an hour at the worst point of a part "life"; None where they are at random. searches: {surface: summary
        of its search}: rough surfaces and the body with the features have one in each contact."""
        own = searches[life["surface"]]
        return self.each[life["surface"]] if own.get("rough") or own.get("carries_feature") else self.pair


def of_gears(n1, z1, z2, on):
    """The ContactRates of a pair with z1 teeth of the pinion, which makes n1 turns a minute, and z2 of the gear; body a is a
    tooth of the one that `on` names. Two teeth meet again after the least common multiple of both numbers."""
    meshes = 60 * n1 * z1
    a, b = (z1, z2) if on == "pinion" else (z2, z1)
    return ContactRates({"a": meshes / a, "b": meshes / b}, meshes / math.lcm(a, b))


def of_ring(bearing, ring):
    """The ContactRates of the record of a ring (body a) with its elements, of the record of a bearing; a point of an element
    touches both rings in turn."""
    return ContactRates({"a": HOUR * ring["passes_per_s"], "b": HOUR * bearing["element_passes_per_s"] / 2})


def with_hours(summary, rates):
    """A summary whose part "life" has `hours` with their error, where it has that part and rates (ContactRates) are known."""
    if not (rates and summary and "life" in summary):
        return summary
    life = summary["life"]
    if not (often := rates.of(life, by_surface(summary))):
        return summary
    error = life["error"]["passages"]
    errors = {**life["error"], "hours": None if error is None else error / often}
    return {**summary, "life": {**life, "hours": life["passages"] / often, "error": errors}}
