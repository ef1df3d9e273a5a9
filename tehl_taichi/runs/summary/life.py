"""Passages to crack initiation at the point that decides the verdict, from the slope of the S-N curve."""

import math

from tehl_taichi.fatigue import judged_layers
from tehl_taichi.fatigue.pressure_alone import searched, why_none
from tehl_taichi.values.coded_text import reasons_of, unknown_of
from tehl_taichi.values.digits import micrometres, with_error
from tehl_taichi.values.summary_values import error_of

LEAST = 1e-9  # of an index, below which no number of passages is of use


def of_searches(searches, fatigue):
    """Part "life" of a summary; {} without fatigue.exponent or an index.

    searches: {surface: summary of its search}, with errors; fatigue: the section of the scene.
    """
    if not fatigue.exponent or not searches or any(map(why_none, searches.values())):
        return {}
    point, early = judged_layers.judged_point(searches), judged_layers.deciding(searches)[1]
    if point.Fi <= LEAST:
        return {}
    reasons = reasons_of(point.part)
    return {**_passages(point.Fi, point.error, fatigue), "surface": point.surface, "depth_m": point.depth,
            "length_m": point.length, "resolved": early,
            **unknown_of({"passages": reasons[point.key]} if point.key in reasons else {}),
            **_of_load(searches, fatigue, point.Fi)}


def _passages(Fi, error, fatigue):
    """Numbers of a part "life" that follow from an index, its error (or None) and the section of the scene."""
    passages = fatigue.limit_cycles * Fi**-fatigue.exponent
    return {"passages": passages, "exponent": fatigue.exponent, "limit_cycles": fatigue.limit_cycles, "Fi": Fi,
            "error": {"passages": bar(passages, Fi, error, fatigue.exponent)}}


def _of_load(searches, fatigue, Fi):
    """{"contact_alone": part "life" of the worse smooth contact} if its index is larger than Fi by more than its error, so that
    the load alone initiates a crack earlier; else {}.
    """
    found = [(name, one) for name, part in searches.items() if (one := searched(part).get("contact_alone"))]
    if not found:
        return {}
    name, alone = max(found, key=lambda named: named[1]["Fi_max"])
    error = error_of(alone, "Fi_max")
    if error is None or alone["Fi_max"] - error <= Fi:
        return {}
    return {"contact_alone": {**_passages(alone["Fi_max"], error, fatigue), "surface": name, "depth_m": alone["depth_m"]}}


def part(searches, fatigue):
    """{"life": that part}, {} without one."""
    found = of_searches(searches, fatigue)
    return {"life": found} if found else {}


def bar(passages, Fi, error, exponent):
    """Error of the number of passages: the larger side of its interval for the error of the index; None if the interval is
    unbounded.
    """
    if error is None or error >= Fi:
        return None
    try:
        return passages * math.expm1(-exponent * math.log1p(-error / Fi))
    except OverflowError:
        return None


def number(life):
    """Text of the number of passages: with its error, or as an interval if the error is as large as the number."""
    passages, error = life["passages"], life["error"]["passages"]
    if error is None or error < passages:
        return with_error(passages, error, digits=2) + " (error unknown)" * (error is None)
    m, limit = life["exponent"], life["limit_cycles"]
    Fi_error = life["Fi"] - ((passages + error) / limit) ** (-1 / m)
    return f"{limit * (life['Fi'] + Fi_error) ** -m:.2g} to {passages + error:.2g}"


def place(life):
    """Text of the place of a part "life"."""
    where = f"{micrometres(life['depth_m'])} µm below surface" if life["depth_m"] else "at surface"
    return f"{where} {life['surface']}"


def words(life):
    """Text such as 'after 5.3e5 ± 0.4e5 passages', without a subject, for a part "life" of a summary."""
    slope = f"by the exponent {life['exponent']:g} of the S-N curve"
    most = "; pressures that the grid does not resolve can only lower the number" * life.get("resolved", False)
    if alone := life.get("contact_alone"):
        most += f"; by the load alone, without any feature, {place(alone)} after {number(alone)}"
    if life["Fi"] < 1:
        return f"below the limit, which stands for {life['limit_cycles']:.3g} passages; {slope} after {number(life)}{most}"
    return f"after {number(life)} passages, {slope}{most}"
