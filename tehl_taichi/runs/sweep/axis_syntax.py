"""Syntax of `--over`: keys and their values, as lists, ranges and spans, and keys that change together."""

import json
import math
import os
import re
import tomllib
from dataclasses import dataclass

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.values import units
from tehl_taichi.values.checks import HUGE
from tehl_taichi.values.coerce import plain, shown

FORMS = "as in srr=-0.3:0.3:7, srr=-0.1,0,0.1, load=1kN:5kN:3 or speed=0.1:10:5:log"
END = rf"{units.NUMBER}[^:,\"'\[\]{{}}]*"  # of a range, with or without a unit
RANGE = re.compile(rf"\s*({END}):({END})(?::(\d+))?(:log)?\s*((?:{units.NAME})?)\s*")
NEXT_KEY = re.compile(r"\s+(?=[A-Za-z_][\w.]*\s*=)")
MOST = 100_000  # values of a range
DIGITS = 12  # of the values of a range: 0.1 * 3 is 0.3 there


@dataclass(frozen=True)
class Axis:
    """Keys (as the user wrote them) that change together, and rows with one value per key for each step."""

    keys: tuple
    rows: tuple

    def changes(self, n):
        """{key: value} of step n."""
        return dict(zip(self.keys, self.rows[n]))


@dataclass(frozen=True)
class Span:
    """Interval from low to high, for samples; log: evenly distributed in the logarithm; unit: as the user wrote it, "" for
    SI.
    """

    low: float
    high: float
    log: bool = False
    unit: str = ""

    def converted(self, convert):
        """Span in SI; convert: function of a list of texts with units."""
        if not self.unit:
            return self
        low, high = convert([_with_unit(end, self.unit) for end in (self.low, self.high)])
        return Span(low, high, self.log)

    def at(self, share):
        """Value at a share 0..1 of the span."""
        if self.log:
            return math.exp(math.log(self.low) + share * math.log(self.high / self.low))
        return self.low + share * (self.high - self.low)


def axis_of(text):
    """Axis of one --over: 'key=values', or several with blanks between, which change together. Raises SceneError."""
    pairs = _pairs(text)
    return axis([key for key, _ in pairs], [parse(values) for _, values in pairs])


def _pairs(text):
    """[(key, text of its values)] of one --over. Raises SceneError."""
    parts = [part.partition("=") for part in NEXT_KEY.split(text.strip())]
    for key, equals, values in parts:
        if not equals or not key.strip() or not values.strip():
            raise SceneError(f"--over {text!r} must look like key=values, {FORMS}")
    return [(key.strip(), values) for key, _, values in parts]


def axis(keys, columns):
    """Axis of keys with a column of values each. Raises SceneError for columns of different length or a repeated row."""
    if any(isinstance(column, Span) for column in columns):
        key, span = next((k, c) for k, c in zip(keys, columns) if isinstance(c, Span))
        raise SceneError(f"{key} = {span.low:g}:{span.high:g} has no number of values; use {span.low:g}:{span.high:g}:N "
                         "(in a sweep also --samples N for all keys)")
    lengths = {key: len(column) for key, column in zip(keys, columns)}
    if len(set(lengths.values())) > 1:
        raise SceneError("keys that change together need equally many values: "
                         + ", ".join(f"{key} has {count}" for key, count in lengths.items()))
    rows = tuple(zip(*columns))
    check_apart(keys, rows, "is given twice")
    if not rows:
        raise SceneError(f"{', '.join(keys)} has no values")
    return Axis(tuple(keys), rows)


def check_apart(keys, rows, why):
    """Refuse a repeated row, for the reason `why`. Raises SceneError."""
    seen = set()
    for row in rows:
        same = tuple(value if isinstance(value, (int, float)) else repr(value) for value in row)  # 1 is 1.0
        if same in seen:
            raise SceneError(f"{', '.join(keys)} = {', '.join(map(shown, row))} {why}")
        seen.add(same)


def parse(text):
    """List of values, or Span, of 'a,b,c', 'a:b:n', 'a:b:n:log' or 'a:b'. Raises SceneError.

    Numbers may have units; a unit after the last number holds for all.
    """
    if (found := _range(text)) is not None:
        return found
    items = _items(text)
    unit = _unit_of_all(text, items)
    return [value for item in items for value in _listed(item, unit)]


def _unit_of_all(text, items):
    """Unit that only the last of several numbers has; "" if each number has one, or none. Raises SceneError if only some have
    one.
    """
    found = [units.split(item) for item in items]
    own = [one[1] for one in found if one]
    if len(own) < len(items) or not any(own) or all(own):
        return ""
    bare = next(one[0] for one in found if not one[1])
    if not own[-1] or any(own[:-1]):
        raise SceneError(f"{text}: {bare} has no unit; give each number its unit, or one behind the last number for all")
    return own[-1]


def _with_unit(value, unit):
    """A number as text that the unit parser reads."""
    return f"{value:.{DIGITS}g} {unit}"


def column(values):
    """Values of an axis from Python: an array, a list, or text as above; a number is a list of one."""
    if isinstance(values, (Span, list)):
        return values if isinstance(values, Span) else [plain(value) for value in values]
    if isinstance(values, str):
        return parse(values)
    values = plain(values)
    return list(values) if isinstance(values, tuple) else [values]


def _listed(item, unit):
    found = _range(item)
    if isinstance(found, Span):
        raise SceneError(f"{item} in a list has no number of values, {FORMS} (decimals need a point, no comma)")
    if found is not None:
        return found
    bare = unit and not units.split(item)[1]
    return [f"{item} {unit}" if bare else _value(item)]


def _range(text):
    """Values, or the Span, of a text with colons between numbers; None for other texts. Raises SceneError."""
    match = RANGE.fullmatch(text)
    low, high = [units.split(end) for end in match.groups()[:2]] if match else [None, None]
    if match is None or low is None or high is None:
        _refuse_colons(text)
        return None
    count, log, behind = match.groups()[2:]
    if behind:
        low, high = _unit_behind(text, low, high, behind)
    a, b, unit = units.in_same_unit(text.strip(), low, high)
    _check_range(text.strip(), a, b, count, log)
    if count is None:
        return Span(a, b, bool(log), unit)
    values = _spread(a, b, int(count), log)
    whole = all(value.is_integer() for value in values) and all(re.fullmatch(r"[-+]?\d+", end) for end, _ in (low, high))
    values = [int(value) for value in values] if whole else values
    return [_with_unit(value, unit) for value in values] if unit else values


def _refuse_colons(text):
    """Refuse a text that looks like a range but is none. Raises SceneError."""
    ends = text.split(":")
    if len(ends) > 1 and not set(text) & set(",\"'[]{}") and units.split(ends[0]) and (units.split(ends[1]) or not ends[1]):
        raise SceneError(f"{text.strip()} is no range; allowed: low:high:N with a whole number N, or low:high:N:log, {FORMS}")


def _unit_behind(text, low, high, unit):
    """Both ends with the unit that follows the whole range."""
    if low[1] or high[1]:
        raise SceneError(f"{text.strip()}: {shown(unit)} is one unit too many; give the unit of the ends or one at the end")
    return (low[0], unit), (high[0], unit)


def _check_range(text, a, b, count, log):
    if log and not (a > 0 and b > 0):
        raise SceneError(f"{text}: a logarithmic range needs positive ends")
    if count is None and not a < b:
        raise SceneError(f"{text}: the first end must be smaller than the second (decimals need a point, no comma)")
    if count is not None and (not 1 <= int(count) <= MOST or (int(count) == 1 and a != b)):
        raise SceneError(f"{text} must have 2 to {MOST} values, {FORMS}")


def _spread(a, b, count, log):
    values = np.geomspace(a, b, count) if log else np.linspace(a, b, count)
    return [_round_value(value, abs(b - a)) for value in values.tolist()]


def _round_value(value, length):
    """Rounded value of a range; exactly 0 near 0, because SRR = 5e-17 would be a scene with slip."""
    return 0.0 if abs(value) < 10**-DIGITS * length else float(f"{value:.{DIGITS}g}")


def _items(text):
    """Items of a text between commas that are not inside brackets or quotes."""
    items, depth, quote, start = [], 0, "", 0
    for n, letter in enumerate(text):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "\"'":
            quote = letter
        elif letter in "[]{}":
            depth += 1 if letter in "[{" else -1
        elif letter == "," and not depth:
            items.append(text[start:n])
            start = n + 1
    return [item.strip() for item in (*items, text[start:])]


def _value(text):
    """Value of a text by the rules of TOML; if it is no TOML value, the text itself."""
    if not text:
        raise SceneError(f"a value is missing between two commas, {FORMS}")
    try:
        return plain(tomllib.loads(f"v = {text}")["v"])
    except (ValueError, RecursionError):
        return text


def over_of(texts, sampled=False):
    """{key, or tuple of keys that change together: values} of several --over, for :func:`tehl_taichi.runs.sweep.plan.plan`.
    Raises SceneError. sampled: values may be spans.
    """
    out = {}
    for text in texts:
        pairs = _pairs(text)
        if sampled and len(pairs) == 1:
            keys, values = pairs[0][0], parse(pairs[0][1])
        else:
            found = axis_of(text)
            keys, values = (found.keys[0], [row[0] for row in found.rows]) if len(found.keys) == 1 else (found.keys, found.rows)
        if keys in out:
            raise SceneError(f"{keys} is swept twice: give all its values in one --over")
        out[keys] = values
    return out


def all_numbers(values):
    """Whether a key's values are numbers, not words or switches."""
    return all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values)


def real(value):
    """A whole number as the float that equals it; other values unchanged."""
    return float(value) if all_numbers([value]) and abs(value) <= HUGE else value


def word(value):
    """A value as text, in the syntax of a scene file: true, [1e-05]."""
    return value if isinstance(value, str) else os.fspath(value) if isinstance(value, os.PathLike) else json.dumps(value)


def short_word(value):
    """A value as text, a number with six digits."""
    return f"{value:g}" if isinstance(value, float) else word(value)
