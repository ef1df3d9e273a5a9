"""Fatigue criteria, one file each: a new file here is a new choice of `fatigue.criterion` (see `criterion`).

A criterion is a pointwise function of the stresses on a plane; `fatigue` finds the plane with the largest value. May import
`engine.pointwise` and `values`; criteria know no scenes, and need taichi only in kernels.
"""

import sys

from tehl_taichi.laws.criteria.criterion import Criterion
from tehl_taichi.values.registry import collect

CRITERIA = collect(sys.modules[__name__], Criterion)


def sensitivities():
    """Text of the meaning of kappa for each criterion."""
    names_of = {}
    for name, criterion in CRITERIA.items():
        names_of.setdefault(criterion.sensitivity, []).append(name)
    return "; ".join(f"{', '.join(names)}: {meaning}" for meaning, names in names_of.items())
