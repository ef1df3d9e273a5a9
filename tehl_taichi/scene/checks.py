"""Checks at the door: one sentence with the value, the unit and what is allowed."""

import dataclasses
import difflib
import math

from tehl_taichi.errors import SceneError


def number(where, value, unit="", low=-math.inf, high=math.inf, strict=False, infinite=False):
    """Refuse `value` unless it is a number within low..high (`strict`: low itself is refused too)."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or math.isnan(value):
        raise SceneError(f"{where} = {value!r} is not a number{_allowed(unit, low, high, strict)}")
    if math.isinf(value) and not infinite:
        raise SceneError(f"{where} = {value} must be finite{_allowed(unit, low, high, strict)}")
    if value < low or value > high or (strict and value == low):
        raise SceneError(f"{where} = {value:g}{' ' + unit if unit else ''} is out of range"
                         f"{_allowed(unit, low, high, strict)}")


def _allowed(unit, low, high, strict):
    unit = " " + unit if unit else ""
    above = f"{'more than' if strict else 'at least'} {low:g}{unit}" if low > -math.inf else ""
    below = f"at most {high:g}{unit}" if high < math.inf else ""
    both = " and ".join(part for part in (above, below) if part)
    return f"; allowed: {both}" if both else ""


def integer(where, value, low, high):
    """Refuse `value` unless it is a whole number within low..high."""
    if isinstance(value, bool) or not isinstance(value, int):
        raise SceneError(f"{where} = {value!r} is not a whole number; allowed: {low} to {high}")
    if not low <= value <= high:
        raise SceneError(f"{where} = {value} is out of range; allowed: {low} to {high}")


def choice(where, value, allowed):
    """Refuse `value` unless it is one of `allowed`; names the nearest one."""
    if value not in allowed:
        words = ", ".join(filter(None, allowed))
        raise SceneError(f"{where} = {value!r} is not known; allowed: {words}{nearest(value, allowed)}")


def flag(where, value, other=""):
    """Refuse anything but true or false (`other`: a word that the caller allows too)."""
    if not isinstance(value, bool):
        raise SceneError(f"{where} = {value!r} must be " + (f"true, false or {other!r}" if other else "true or false"))


def text(where, value):
    """Refuse anything but words."""
    if not isinstance(value, str):
        raise SceneError(f"{where} = {value!r} must be words in quotes")


def nearest(word, allowed):
    """' (did you mean ...?)' for the closest known word, or nothing."""
    close = difflib.get_close_matches(str(word), [str(a) for a in allowed], n=1, cutoff=0.5)
    return f" (did you mean {close[0]!r}?)" if close else ""


def build(cls, values, section):
    """cls(**values) with unknown keys refused and whole numbers taken for floats where a float is meant."""
    if not isinstance(values, dict):
        raise SceneError(f"[{section}] must be a table of keys and values, not {values!r}")
    known = {f.name: f for f in dataclasses.fields(cls)}
    for key in values:
        if key not in known:
            raise SceneError(f"unknown key {section}.{key}{nearest(key, known)}; known: {', '.join(known)}")
    return cls(**{key: _convert(known[key], value) for key, value in values.items()})


def _convert(field, value):
    if field.type in (float, "float") and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if isinstance(value, list):
        return tuple(tuple(v) if isinstance(v, list) else v for v in value)
    return value
