"""Passages to crack initiation at the worst point, from the slope of the S-N curve."""

import math

from tehl_taichi.fatigue import material_length
from tehl_taichi.fatigue.pressure_alone import searched, why_none
from tehl_taichi.values.coded_text import reasons_of, unknown_of
from tehl_taichi.values.digits import with_error

LEAST = 1e-9  # of an index, below which no number of passages is of use


def of_searches(searches, fatigue):
    """Part "life" of a summary; {} without fatigue.exponent or an index.

    searches: {surface: summary of its search}, with errors; fatigue: the section of the scene.
    """
    found = [(name, *part) for name, one in searches.items() if not why_none(one) for part in _parts(searched(one))]
    surface, worst, key = max(found, key=lambda one: one[1][one[2]], default=("", {}, ""))
    Fi, error = worst.get(key, 0.0), worst.get("error", {}).get(key)
    if not fatigue.exponent or Fi <= LEAST:
        return {}
    passages, reasons = fatigue.limit_cycles * Fi**-fatigue.exponent, reasons_of(worst)
    return {"passages": passages, "exponent": fatigue.exponent, "limit_cycles": fatigue.limit_cycles, "Fi": Fi,
            "surface": surface, "depth_m": worst.get("depth_m", 0.0),
            "error": {"passages": bar(passages, Fi, error, fatigue.exponent)},
            **unknown_of({"passages": reasons[key]} if key in reasons else {})}


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


def _parts(found):
    """[(part of a search, its index)] at the surface and below it, as in the verdict."""
    if found.get("rough"):
        both = found["statistics"], found.get("below", {}).get("statistics")
        return [(part, "p99") for part in both if part]
    return [(part, "Fi_max") for part, _ in material_length.leading(found)]


def number(life):
    """Text of the number of passages: with its error, or as an interval if the error is as large as the number."""
    passages, error = life["passages"], life["error"]["passages"]
    if error is None or error < passages:
        return with_error(passages, error, digits=2) + " (error unknown)" * (error is None)
    m, limit = life["exponent"], life["limit_cycles"]
    Fi_error = life["Fi"] - ((passages + error) / limit) ** (-1 / m)
    return f"{limit * (life['Fi'] + Fi_error) ** -m:.2g} to {passages + error:.2g}"


def words(life):
    """Text such as 'after 5.3e5 ± 0.4e5 passages', without a subject, for a part "life" of a summary."""
    slope = f"by the exponent {life['exponent']:g} of the S-N curve"
    if life["Fi"] < 1:
        return f"below the limit, which stands for {life['limit_cycles']:.3g} passages; {slope} after {number(life)}"
    return f"after {number(life)} passages, {slope}"
