"""All numbers of a summary by their full names, with error, unit, and the reason of an unknown error."""

import math

from tehl_taichi.errors import UnknownName
from tehl_taichi.values.checks import known_names, nearest
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.estimate import Quantity
from tehl_taichi.values.summary_units import unit_of, without_unit

FIRST = ("transient", "steady", "fatigue")  # parts whose numbers are meant by a name without its part, in this order
BARS = ("error", "unknown", "unknown_codes", "error_parts")  # of a part: not numbers themselves
ALONE = {"pressure_alone", "contact_alone", "contact_alone_by_surface"}  # numbers of something else: found by their part only


def all_numbers(summary):
    """{full name, such as "transient.p_max_Pa": Quantity} of all numbers of a summary; nan with the reason for one that has no
    value.
    """
    return dict(_numbers(summary, ""))


def _numbers(values, above):
    for key, value in values.items():
        if isinstance(value, dict) and key not in BARS:
            yield from _numbers(value, f"{above}{key}.")
        elif value is None and key in values.get("unknown", {}):
            yield above + key, Quantity(math.nan, None, unit_of(key), values["unknown"][key], above + key)
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            error, why = values.get("error", {}).get(key), ""
            if error is None and key in values.get("error", {}):
                why = values.get("unknown", {}).get(key, "not estimated")
            yield above + key, Quantity(value, error, unit_of(key), why, above + key)


def find(summary, name):
    """Quantity with this name, with or without its part and its unit. Raises UnknownName."""
    known = all_numbers(summary)
    fitting = _fitting(known, name)
    if not fitting:
        meant = [min(_names(full), key=len) for full in sorted(known, key=_order)
                 if isinstance(name, str) and name in _keys(full)]
        hint = f" (did you mean {meant[0]!r}?)" if meant else nearest(name, _short(known))
        raise UnknownName(f"{shown(name)} is no number of this run{hint}; {known_names(known, 'list(run)')}")
    return known[min(fitting, key=_order)]


def contains(summary, name):
    """Whether :func:`find` finds a number with this name."""
    return bool(_fitting(all_numbers(summary), name))


def _fitting(known, name):
    """Full names of the numbers with this name."""
    return [full for full in known if name in _names(full)] if isinstance(name, str) else []


def _names(full):
    """All short names of a full one."""
    part, keys = full.rpartition(".")[0], _keys(full)
    return {f"{part}.{one}" for one in keys} | (set() if ALONE & set(part.split(".")) else keys)


def _keys(full):
    """The name of a number without its part, with and without its unit."""
    key = full.rpartition(".")[2]
    return {key, without_unit(key)}


def _short(known):
    """The shortest name of each number."""
    return {min(_names(full), key=len) for full in known}


def _order(full):
    """Sort key: parts in the order of FIRST, numbers of a part before those of parts inside it."""
    parts = full.split(".")
    return FIRST.index(parts[0]) if parts[0] in FIRST else len(FIRST), len(parts)
