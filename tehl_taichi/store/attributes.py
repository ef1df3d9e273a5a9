"""Check the attributes of a store: refuse edited tables before they are used."""

import json

from tehl_taichi.values.coerce import shown

NUMBERS = "_m", "_Pa", "_C", "_K", "_s", "_deg", "_error", "_fraction", "Fi_max", "ripple", "steps", "cycles", "kappa_F"
LISTS = ("warnings", "warning_codes", "results", "outputs")  # of texts
KINDS = {dict: "a table", list: "a list", str: "text", int: "a whole number", float: "a number", bool: "true or false"}
NEEDED = {"scene": str, "version": str, "wall_s": float, "compile_s": float, "steps": int, "grid": dict, "hertz": dict,
          "left_out": list, "steady": dict, "work": dict, "clamps": dict, "warnings": list}  # entries of every summary
SUMMARY = {**NEEDED, "cells": dict, "crowding": list, "transient": dict, "fatigue": dict, "fatigue_by_surface": dict,
           "surface": str, "error": dict, "unknown": dict, "run_in": dict, "below": dict, "averaged": dict, "von_mises": dict,
           "life": dict, "contact_alone": dict, "contact_alone_by_surface": dict, "searched_m": list, "pit_angles_deg": list,
           "criterion": str, "domain": dict, "error_parts": dict, "peclet": dict, "warning_codes": list, "warning_data": list,
           "unknown_codes": dict}
TABLES = ("", "hertz.", "steady.", "transient.", "fatigue.", "fatigue.below.", "fatigue.contact_alone.", "contact_alone.")
STEADY = ("h_c_m", "h_min_m", "p_max_Pa", "error", "unknown")


def invalid_attribute(attrs, whole):
    """Description of an attribute that no tehl writes in this form, or "". whole: the store is of this version, so no attribute
    may be missing.
    """
    for name in LISTS:
        found = _parsed(attrs.get(name, "[]"))
        if isinstance(found, list) and (odd := [one for one in found if not isinstance(one, str)]):
            return f"its attribute {name!r} holds {shown(odd[0])}, not only texts"
    found = _parsed(attrs.get("summary", "{}"))
    known = isinstance(found, dict) and found  # else there is none: readers do without
    of_ours = known and whole and {"scene", "steady"} & found.keys()
    reason = (_missing(found) if of_ours else "") or _wrong_numbers(found) if known else ""
    return reason and f"of its attribute 'summary' {reason}"


def text(attrs, name, default="unknown"):
    """Text of an attribute; `default` if it is missing or no text."""
    found = attrs.get(name)
    return found if isinstance(found, str) else default


def _parsed(text):
    try:
        return json.loads(text)
    except (TypeError, ValueError):
        return None


def _missing(summary):
    if missing := [name for name in NEEDED if name not in summary]:
        return f"{missing[0]!r} is missing"
    steady = summary["steady"]
    missing = [name for name in STEADY if name not in steady] if isinstance(steady, dict) else []
    return f"'steady.{missing[0]}' is missing" if missing else ""


def _wrong_numbers(table, above=""):
    """First entry of a (nested) table with a wrong type, as text, or ""."""
    for name, value in table.items():
        kind = _kind(name, above)
        if kind and not _is(value, kind):
            return f"'{above}{name}' is {shown(value)}, not {KINDS[kind]}"
        if isinstance(value, dict) and (reason := _wrong_numbers(value, f"{above}{name}.")):
            return reason
    return ""


def _kind(name, above):
    """Expected type of an entry; None: any type, as for entries of later versions."""
    if above.endswith(("unknown.", "unknown_codes.", "error.")):
        return float if above.endswith("error.") else str
    if "error_parts." in above:
        return dict if above.endswith("error_parts.") else float
    if above not in TABLES:
        return None
    return SUMMARY.get(name, float if name.endswith(NUMBERS) else None)


def _is(value, kind):
    if kind is float:
        return value is None or isinstance(value, (int, float)) and not isinstance(value, bool)
    return isinstance(value, kind) and (kind is not int or not isinstance(value, bool))
