"""Entry type of hardening laws."""

from collections.abc import Callable
from dataclasses import dataclass

from tehl_taichi.values.registry import Entry


@dataclass(frozen=True, kw_only=True)
class HardeningLaw(Entry):
    """flow_stress(yield_stress, strain): Pa, for arrays; strain: equivalent plastic strain >= 0; the result never decreases
    with it.
    """

    flow_stress: Callable
