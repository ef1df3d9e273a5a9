"""Hardening laws of steel, one file each: a new file here is a new choice of `bodies.X.hardening`.

A law gives the flow stress from the yield stress and the accumulated plastic strain. May import `values`.
"""

import sys

from tehl_taichi.laws.hardening.hardening_law import HardeningLaw
from tehl_taichi.values.registry import collect

HARDENINGS = collect(sys.modules[__name__], HardeningLaw)
