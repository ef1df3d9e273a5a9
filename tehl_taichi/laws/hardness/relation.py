"""Entry type of relations between hardness and fatigue limit."""

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Optional

from tehl_taichi.errors import SceneError
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.values.registry import Entry


@dataclass(frozen=True, kw_only=True)
class HardnessRelation(Entry):
    """A relation. Either findley(HV) gives (kappa, sigma_eF in Pa) of Findley's criterion, or bending(HV, inclusion, inside)
    the limit in reversed bending (Pa), from which sigma_eF follows for any criterion with the kappa of the scene.

    spread: of its data, as text; low, high: HV range of the data; inclusion: bending needs the size (m) of the largest
    inclusion, which lies `inside` or cuts the surface.
    """

    spread: str
    low: float
    high: float
    findley: Optional[Callable] = None
    bending: Optional[Callable] = None
    inclusion: bool = False

    def check(self, fatigue):
        """Refuse a criterion or an inclusion that does not fit the relation. Raises SceneError."""
        if self.findley and fatigue.criterion != "findley":
            raise SceneError(f"fatigue.relation = {self.name!r} gives constants of the criterion findley, not of "
                             f"{fatigue.criterion}; allowed for that: rotating-bending, murakami")
        if self.inclusion and not fatigue.inclusion:
            raise SceneError(f"fatigue.inclusion = 0 m: the relation {self.name!r} needs the root of the area of the largest "
                             "inclusion, in m")

    def constants(self, HV, fatigue, kappa, inside):
        """(kappa, sigma_eF in Pa) at a hardness; fatigue: the section of the scene; kappa: used if the relation gives none."""
        if self.findley:
            return self.findley(HV)
        return kappa, _in_bending(fatigue.criterion, self.bending(HV, fatigue.inclusion, inside), kappa)


@functools.lru_cache(4096)
def _in_bending(criterion, limit, kappa):
    return CRITERIA[criterion].in_bending(limit, kappa)
