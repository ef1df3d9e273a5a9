"""Latin hypercube: N samples of several keys; the range of each key has N equal parts with one sample in each."""

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.sweep.axis_syntax import DIGITS, Axis, Span, all_numbers, check_apart
from tehl_taichi.values import checks, units
from tehl_taichi.values.coerce import plain


def latin_hypercube(columns, samples, seed=0, whole=()):
    """Axis with `samples` rows. Raises SceneError.

    columns: {key: Span, or a list of values, each used about equally often}; whole: keys whose samples are rounded to whole
    numbers. Source: McKay, Beckman, Conover, Technometrics 21 (1979) 239.
    """
    for name, value, least in (("samples", samples, 1), ("seed", seed, 0)):
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
            raise SceneError(f"{name} = {value!r} must be a whole number of at least {least}")
    rng = np.random.default_rng(int(seed))
    drawn = []
    for key, values in columns.items():
        shares = (rng.permutation(samples) + rng.random(samples)) / samples
        drawn.append([_choose(values, share, key in whole) for share in shares.tolist()])
    rows = tuple(zip(*drawn))
    check_apart(columns, rows, f"is drawn twice among {samples} samples; allowed: fewer samples, or a range low:high of a key")
    return Axis(tuple(columns), rows)


def _choose(values, share, whole):
    if not isinstance(values, Span):
        return values[int(share * len(values))]
    value = float(f"{values.at(share):.{DIGITS}g}")
    return round(value) if whole else value


def interval(key, ends):
    """Text "low:high" of a tuple of two ends; "" for other values, which are choices. Raises SceneError unless they are finite.

    >>> interval("srr", (-0.1, "10%")), interval("rheology.law", ("eyring", "newtonian"))
    ('-0.1:10%', '')
    """
    both = plain(ends) if isinstance(ends, tuple) and len(ends) == 2 else ()
    return ":".join(_end(key, end) for end in both) if both and all(map(_is_end, both)) else ""


def _is_end(value):
    """Whether a value is a number, or the text of one with or without a unit."""
    return bool(units.split(value)) if isinstance(value, str) else all_numbers([value])


def _end(key, value):
    if isinstance(value, str):
        return value
    checks.number(key, value)
    return repr(float(value))
