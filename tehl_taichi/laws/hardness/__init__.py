"""Relations between hardness and fatigue limit, one file each: a new file here is a new choice of `fatigue.relation`.

A relation is a formula of the Vickers hardness, with its source and the spread of its data. May import `laws.criteria` and
`values`.
"""

import sys

from tehl_taichi.laws.hardness.relation import HardnessRelation
from tehl_taichi.values.registry import collect

RELATIONS = collect(sys.modules[__name__], HardnessRelation)
