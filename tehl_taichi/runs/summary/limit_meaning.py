"""Meaning of a fatigue limit: the equivalent pressure of a smooth contact, and equivalent limits of a specimen."""

import math

from tehl_taichi.fatigue.pressure_alone import searched
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.values.digits import with_error
from tehl_taichi.values.summary_values import error_of

# Error of a pressure in proportion to the index, as a share of it, per factor e between both: friction and depth change, too
# (smooth line, isothermal: 1.611 GPa by an index of 1.2, 1.620 iterated; 0.604 by 3.2, 0.663)
DISPROPORTION = 0.1


def smooth_pressure(summary):
    """(Hertz pressure (Pa) at which the smooth contact of a run would have the index 1, its error), by proportion; None without
    such an index, or with residual stress, which does not grow with the pressure.
    """
    alone = _alone(summary)
    if not alone or not alone["Fi_max"] > 0 or error_of(alone, "Fi_max") is None or alone.get("residual_counted"):
        return None
    found = summary["hertz"]["p_Pa"] / alone["Fi_max"]
    return found, found * math.hypot(alone["error"]["Fi_max"] / alone["Fi_max"], DISPROPORTION * math.log(alone["Fi_max"]))


def _alone(summary):
    """Index of the worse smooth body, {} if none is known."""
    bodies = summary.get("fatigue_by_surface") or {"": summary.get("fatigue", {})}
    found = [part for one in bodies.values() if (part := searched(one).get("contact_alone"))]
    found = found or [summary["contact_alone"]] * ("contact_alone" in summary)
    return max(found, key=lambda part: part["Fi_max"], default={})


def sentence(summary, fatigue, place="like this one"):
    """Sentence about the meaning of the limit, "" if no smooth contact is known; fatigue: the section of the scene; place: text
    of the contact.
    """
    if not (found := smooth_pressure(summary)):
        return ""
    value, error = (one * 1e-9 for one in found)
    contact = f"a smooth contact {place} has Fi = 1 at about {with_error(value, error, 'GPa')}"
    if fatigue.limit_of == "contact":
        return f"The limit is meant as that of a contact: {contact}."
    return f"The limit is meant as that of a specimen{_in_tests(fatigue)}; {contact}."


def _in_tests(fatigue):
    """Text of the equivalent limits in reversed bending and torsion, if one limit holds for every depth and body."""
    if any(map(fatigue.table_text, "ab")):
        return ""
    rule, limit = CRITERIA[fatigue.criterion], fatigue.endurance
    bending, torsion = (limit * limit / of(limit, fatigue.kappa) for of in (rule.in_bending, rule.in_torsion))
    return f" ({bending / 1e6:.4g} MPa in reversed bending, {torsion / 1e6:.4g} MPa in torsion)"
