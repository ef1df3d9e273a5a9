"""Fatigue constants from handbook limits, in fully reversed bending and torsion.

One limit and kappa give sigma_eF: at an amplitude of that limit the index is 1. Both limits also give kappa. The section
[fatigue] converts them once, when it is made; no search knows of limits.
"""

import math

from tehl_taichi.errors import SceneError
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.values.checks import number
from tehl_taichi.values.coerce import plain, text_of

KEYS = ("bending_limit", "torsion_limit")
LEAST_LIMIT, LARGEST_LIMIT, USUAL_LIMIT = 1e6, 1e11, 4e8  # Pa
FROM = "from the fatigue limit"  # begins the source of constants that are given no other


def given_limits(values):
    """Names of the limits among these values."""
    return [key for key in KEYS if plain(values.get(key)) not in (None, 0)]


def derived_keys(values):
    """Names of the constants that the limits in these values determine, () without limits."""
    return ((), ("endurance",), ("kappa", "endurance"))[len(given_limits(values))]


def derived_values(fatigue):
    """{key: value} that the limits of a section [fatigue] determine, and their source unless the user gave one; {} without
    limits. Raises SceneError if the criterion does not fit such a material.
    """
    if not derived_keys(vars(fatigue)):
        return {}
    found = dict(zip(("kappa", "endurance"), _constants(fatigue)))
    own = {} if fatigue.source not in ("", type(fatigue).source) else {"source": words(fatigue, found["kappa"])}
    return {key: found[key] for key in derived_keys(vars(fatigue))} | own


def _constants(fatigue):
    """Constants (kappa, sigma_eF) from the limits."""
    criterion, bending, torsion = CRITERIA[fatigue.criterion], fatigue.bending_limit, fatigue.torsion_limit
    if bending and torsion:
        return criterion.from_limits(bending, torsion)
    in_one = criterion.in_torsion if torsion else criterion.in_bending
    return fatigue.kappa, in_one(torsion or bending, fatigue.kappa)


def check_agreement(given, fatigue):
    """Refuse constants {key: value} given beside limits that differ from those they determine. Raises SceneError."""
    for key, value in given.items():
        number(f"fatigue.{key}", value)
        if not math.isclose(value, getattr(fatigue, key), rel_tol=1e-6):
            limits = " and ".join(f"fatigue.{name} = {getattr(fatigue, name):g} Pa" for name in given_limits(vars(fatigue)))
            rest = "the limit in bending or torsion" if key == "kappa" else "the limits"
            raise SceneError(f"fatigue.{key} = {value:g} contradicts {limits}, which {'give' if 'and' in limits else 'gives'} "
                             f"{key} = {getattr(fatigue, key):.6g}; omit {key}, or {rest}")


def words(fatigue, kappa=None):
    """Text such as 'from the fatigue limit 400 MPa in reversed torsion with kappa = 0.3', '' without limits; kappa: in place of
    the section's own.
    """
    limits = [f"{getattr(fatigue, key) / 1e6:g} MPa in {'reversed ' * (n == 0)}{key.partition('_')[0]}"
            for n, key in enumerate(given_limits(vars(fatigue)))]
    if len(limits) == 1:
        return f"{FROM} {limits[0]} with kappa = {fatigue.kappa if kappa is None else kappa:g}"
    return f"{FROM}s {' and '.join(limits)}" if limits else ""


def clear_replaced(table, new):
    """Remove from the table of a section all keys that new values {key: value} replace; None marks derived values."""
    if "endurance" in new and not given_limits(new):
        table.update(dict.fromkeys(KEYS, 0.0))
    if "kappa" in new and len(given_limits(new)) == 1:
        table.update(dict.fromkeys(set(KEYS) - set(given_limits(new)), 0.0))
    if {"kappa", "endurance", "criterion", *KEYS} & new.keys():
        table.update(dict.fromkeys(derived_keys({**table, **new})))
        if text_of(table.get("source")).startswith(FROM):
            del table["source"]
