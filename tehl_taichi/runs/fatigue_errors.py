"""Error bars of a repeated fatigue search.

The coarse-grid runs belong to the search of the run; their bars do not hold for another kappa, criterion, window or stress. The
fatigue limit is no part of the search: the index is stress over limit, so its relative error also holds for another limit. It
also holds for other depths if the same point is the worst.
"""

from dataclasses import asdict

from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.fatigue.pressure_alone import searched
from tehl_taichi.march.accuracy.coarse_runs import FI, indices, von_mises_parts
from tehl_taichi.values.coded_text import Reason, reasons_of, unknown_of
from tehl_taichi.values.summary_values import error_of

OTHER = Reason("the coarse-grid runs used the constants and moments of the run, not these", "other")
# of the section [fatigue]: they change no stress of a point (limits do by kappa, which is compared; what a length averages is a
# part of its own)
FREE = ("on", "endurance", "bending_limit", "torsion_limit", "source", "depths", "surfaces", "length", "limit_of", "table",
        "table_b", "exponent", "limit_cycles", "weibull", "reference_volume", "reference_area")
OF_TABLES = ("relation", "inclusion")  # free where there is none
SAME = 1e-6  # of the stress: the stored search and this one are the same


def add_errors(searches, section, store):
    """Add "error" and "unknown" to the summaries of searches, {surface: summary}. section: their [fatigue]; store: of the
    run.
    """
    own, stored = store.scene.fatigue, _parts(by_surface(store.summary))
    free = FREE if any(map(section.table_text, "ab")) else (*FREE, *OF_TABLES)
    alike = all(getattr(section, key) == value for key, value in asdict(own).items() if key not in free)
    for name, part in _parts(searches).items():
        before = stored.get(name, {}) if alike else {}
        part["error"], reasons = _scaled(part, before)
        part |= unknown_of(reasons)
    _add_to_von_mises(searches, by_surface(store.summary))


def _add_to_von_mises(searches, stored):
    """Add the error of a von Mises stress if the stored search has it."""
    before = von_mises_parts(stored)
    for name, part in von_mises_parts(searches).items():
        known = before.get(name, {})
        same = abs(part["max_Pa"] - known.get("max_Pa", 0.0)) <= SAME * part["max_Pa"]
        error, reasons = (known["error"]["max_Pa"], reasons_of(known)) if same else (None, {"max_Pa": OTHER})
        part |= {"error": {"max_Pa": error}, **unknown_of(reasons)}


def _parts(searches):
    """{name: part of a summary with an index} of {surface: summary of its search}."""
    alone = {name: searched(found).get("contact_alone") for name, found in searches.items()}
    return {**indices(searches), **{f"{name}:contact_alone": part for name, part in alone.items() if part}}


def _scaled(part, before):
    """({FI: bar or None}, {FI: reason if there is none}) of a part of a search; before: that part in the stored search, or
    {}.
    """
    stress = "findley_stress_max_Pa"
    if not before or abs(part[stress] - before[stress]) > SAME * abs(before[stress]):
        return {FI: None}, {FI: OTHER}
    bar = error_of(before, FI)
    scaled = None if bar is None else abs(bar * part[FI] / before[FI])
    return {FI: scaled}, reasons_of(before)
