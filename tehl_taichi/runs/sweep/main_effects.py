"""Main effects: the share of the spread of a result that each key of a study accounts for.

All combinations: the variance of the mean over all other keys, over the whole variance (first-order index of Sobol, 1993); the
rest comes from keys together. Samples: variance of each key's part of a fit by a sum of one parabola per number and one mean
per word; the rest is what the fit leaves. Samples without a result are left out; combinations without one mix the keys, so
there are no shares.
"""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.runs.sweep.axis_syntax import all_numbers, word
from tehl_taichi.runs.sweep.summary_columns import error_of, usual_columns

LEAST = 4    # cases with a result
TIMES = 2    # cases of samples for each coefficient of their fit
ROUNDING = 1e-9
WITHIN = 2.0  # of the largest error: a spread (largest less smallest value) below it is none


@dataclass(frozen=True)
class MainEffects:
    """Main effects on one column.

    shares: {keys that change together: share 0 to 1}; together: share of the keys together, None without shares; why: reason
    why there are no shares, "" with them.
    """

    shares: dict
    together: float | None = None
    why: str = ""

    def words(self, key):
        """Text such as "62 % of the spread" of a key, "" without a share; keys that change together have one."""
        share = next((share for keys, share in self.shares.items() if key in keys), None)
        return "" if share is None else f"{share:.0%} of the spread".replace("%", " %")

    def to_dict(self):
        """{"shares": {"srr": share}, "together", "why"}; keys that change together are one: "srr, speed"."""
        return {"shares": {", ".join(keys): share for keys, share in self.shares.items()}, "together": self.together,
                "why": self.why}


def main_effects(study, name):
    """The :class:`MainEffects` of the keys of a study on a column of its table."""
    values, plan = study.values[name], study.plan
    known = np.isfinite(values)
    if why := _why_none(study, name, values[known]):
        return MainEffects({}, None, why)
    y, total = values[known], np.var(values[known])
    numbers = np.flatnonzero(known)
    if plan.drawn:
        factors = {(key,): [plan.changes(n)[key] for n in numbers] for key in plan.keys}
        return _of_samples(factors, y)
    levels = np.array([plan.positions(int(n)) for n in numbers])
    shares = {axis.keys: _of_levels(levels[:, n], y, total) for n, axis in enumerate(plan.axes) if len(axis.rows) > 1}
    return MainEffects(shares, max(0.0, 1.0 - sum(shares.values())))


def usual_effects(study):
    """{column: its :class:`MainEffects`} of the columns shown by default that have some."""
    found = {name: main_effects(study, name) for name in usual_columns(study.values)}
    return {name: one for name, one in found.items() if one.shares}


def _why_none(study, name, y):
    """Reason why a column has no main effects; ""."""
    if not study.plan.drawn and len(y) < len(study.values[name]):
        return "some cases have no result"
    changing = [axis for axis in study.plan.axes if len(axis.rows) > 1]
    if not study.plan.drawn and len(changing) < 2:
        return "only one key changes"
    if len(y) < LEAST:
        return f"fewer than {LEAST} cases have a result"
    bars = study.values.get(error_of(name), np.array([np.nan]))
    largest = np.nanmax(bars) if np.isfinite(bars).any() else 0.0
    alike = np.ptp(y) <= max(WITHIN * largest, ROUNDING * np.abs(y).max())
    return "its values differ by no more than their errors" if alike else ""


def _of_levels(levels, y, total):
    """Variance of the means over the levels of a key, over the total variance."""
    means = [(y[levels == one].mean(), (levels == one).sum()) for one in np.unique(levels)]
    return float(sum(count * (mean - y.mean()) ** 2 for mean, count in means) / len(y) / total)


def _of_samples(columns, y):
    """The :class:`MainEffects` of samples: variance of each key's part of a fit by a sum of parabolas (words: of means)."""
    parts = {keys: _terms(column) for keys, column in columns.items()}
    terms = np.column_stack([np.ones(len(y)), *parts.values()])
    if len(y) < (least := TIMES * terms.shape[1]):
        return MainEffects({}, None, f"fewer than {least} cases have a result")
    factors = np.linalg.lstsq(terms, y, rcond=None)[0]
    ends = np.cumsum([1, *(part.shape[1] for part in parts.values())])
    spread = [np.var(part @ factors[low:high]) for part, low, high in zip(parts.values(), ends, ends[1:])]
    left = np.var(y - terms @ factors) / np.var(y) * (len(y) - 1) / (len(y) - terms.shape[1])
    explained = max(0.0, 1.0 - float(left)) / (sum(spread) or 1.0)  # parts of keys that the samples mix add up to more
    return MainEffects({keys: float(explained * one) for keys, one in zip(parts, spread)}, min(1.0, float(left)))


def _terms(column):
    """Terms (cases, terms) of a key without a constant: x and x², or of each word but the first."""
    if all_numbers(column) and len(set(column)) > 2:
        x = (np.array(column, float) - np.mean(column)) / np.ptp(column)
        return np.column_stack([x, x**2])
    words = [word(value) for value in column]
    return np.array([[one == known for known in dict.fromkeys(words)][1:] for one in words], float).reshape(len(words), -1)
