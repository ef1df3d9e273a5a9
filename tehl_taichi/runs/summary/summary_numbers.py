"""All numbers of a summary by their full names, with error, unit, and the reason of an unknown error."""

from tehl_taichi.errors import UnknownName
from tehl_taichi.values.checks import known_names, nearest
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.estimate import Quantity
from tehl_taichi.values.summary_units import unit_of, without_unit

FIRST = ("transient", "steady", "fatigue")  # parts whose numbers are meant by a name without its part, in this order
BARS = ("error", "unknown", "unknown_codes", "error_parts")  # of a part: not numbers themselves


def all_numbers(summary):
    """{full name, such as "transient.p_max_Pa": Quantity} of all numbers of a summary."""
    return dict(_numbers(summary, ""))


def _numbers(values, above):
    for key, value in values.items():
        if isinstance(value, dict) and key not in BARS:
            yield from _numbers(value, f"{above}{key}.")
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
        raise UnknownName(f"{shown(name)} is no number of this run{nearest(name, _short(known))}; "
                          f"{known_names(known, 'list(run)')}")
    return known[min(fitting, key=_order)]


def contains(summary, name):
    """Whether :func:`find` finds a number with this name."""
    return bool(_fitting(all_numbers(summary), name))


def _fitting(known, name):
    """Full names of the numbers with this name."""
    return [full for full in known if name in _names(full)]


def _names(full):
    """All short names of a full one."""
    part, _, key = full.rpartition(".")
    keys = {key, without_unit(key)}
    return keys | {f"{part}.{one}" for one in keys}


def _short(known):
    return {without_unit(full.rpartition(".")[2]) for full in known}


def _order(full):
    """Sort key: parts in the order of FIRST, numbers of a part before those of parts inside it."""
    parts = full.split(".")
    return FIRST.index(parts[0]) if parts[0] in FIRST else len(FIRST), len(parts)
