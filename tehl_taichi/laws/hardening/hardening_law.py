"""The entry of a hardening law."""

from collections.abc import Callable
from dataclasses import dataclass

from tehl_taichi.values.registry import Entry


@dataclass(frozen=True, kw_only=True)
class HardeningLaw(Entry):
    """flow_stress(yield_stress, strain): Pa, of arrays; strain: equivalent plastic strain, from 0 on, never falling with it."""

    flow_stress: Callable
