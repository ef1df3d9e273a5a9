"""Fatigue criteria, one file each: a new file here is a new choice of `fatigue.criterion` (see `criterion`).

A criterion is a pointwise function of what happens on a plane; `fatigue` looks for the plane where it is largest. May import
`engine.pointwise` and `values`; nothing here knows of scenes, nor needs taichi before a kernel asks.
"""

import sys

from tehl_taichi.laws.criteria.criterion import Criterion
from tehl_taichi.values.registry import collect

CRITERIA = collect(sys.modules[__name__], Criterion)


def sensitivities():
    """What kappa is the sensitivity to, and for which criteria."""
    names_of = {}
    for name, criterion in CRITERIA.items():
        names_of.setdefault(criterion.sensitivity, []).append(name)
    return "; ".join(f"{', '.join(names)}: {meaning}" for meaning, names in names_of.items())
