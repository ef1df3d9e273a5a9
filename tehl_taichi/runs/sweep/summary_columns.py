"""Summary as one row of a table: its numbers with unique names, and their units."""

import math
import re

from tehl_taichi.fatigue.judged_layers import judged_point
from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.fatigue.pressure_alone import why_none
from tehl_taichi.values import summary_units

# what a case has of its own, or what is no number of its result
LEFT_OUT = {"store", "scene", "version", "left_out", "warnings", "warning_codes", "warning_data", "domain", "error_parts",
            "converged", "unknown", "unknown_codes", "clamps", "grid", "cells"}
NAME = re.compile(r"\w[\w.+-]*")  # of an array and its folder, a column and a label
PART = re.compile(r"(fatigue(_by_surface_[ab])?(_resolved|_averaged)?(_below|_contact_alone)?(_statistics|_von_mises)?"
                  r"|contact_alone(_by_surface_[ab])?(_von_mises)?|von_mises|run_in(_by_surface_[ab])?|life_contact_alone"
                  r"|[^_]+)_")  # of a summary, inside others
JUDGED = "judged_Fi"  # the index that decides the verdict
# shown by default: the first of each line that a study has
USUAL = ((JUDGED,), ("transient_h_min_m", "steady_h_c_m"), ("transient_p_max_Pa", "steady_p_max_Pa"),
         ("transient_friction_coefficient_mean", "steady_friction_coefficient"), ("transient_film_max_C", "steady_film_max_C"))


def usual_columns(known):
    """Columns that are shown by default, of those that are known."""
    found = (next((name for name in names if name in known), None) for names in USUAL)
    return [name for name in found if name]


def of_case(summary):
    """Numbers of a summary (see :func:`numbers`), and those of the point that decides its verdict."""
    return numbers({**summary, **_judged(summary)})


def _judged(summary):
    """{"judged": index that decides, with its error and depth}; {} without an index."""
    searches = by_surface(summary)
    if not all(searches.values()) or not searches or any(map(why_none, searches.values())):
        return {}
    point = judged_point(searches)
    return {"judged": {"Fi": point.Fi, "depth_m": point.depth, "error": {"Fi": point.error}}}


def numbers(summary, above=""):
    """{name: number} of a nested summary: "fatigue_Fi_max" is summary["fatigue"]["Fi_max"]; lists and texts are left out."""
    out: dict[str, float] = {}
    for key, value in summary.items():
        if key in LEFT_OUT or not NAME.fullmatch(key):
            continue
        if isinstance(value, dict):
            out |= numbers(value, f"{above}{key}_")
        elif isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value):
            out[above + key] = float(value)
    return out


def error_of(name):
    """Name of the error bar of a number: "fatigue_error_Fi_max" for "fatigue_Fi_max"."""
    if "_" not in name:
        return f"error_{name}"
    found = PART.match(f"{name}_")
    if found is None or found[0] == f"{name}_":  # of no part
        return f"error_{name}"
    return f"{found[0]}error_{name.removeprefix(found[0])}"


def unit_of(name):
    """Unit of a number by the end of its name: h_min_m is in m, load_error has none ("1")."""
    return summary_units.unit_of(name) or "1"
