"""A fatigue search as figures draw it: of the whole passage, and of its resolved part where that is not all."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tehl_taichi.fatigue.pressure_alone import why_none
from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.scene.feature_wording import from_centre, passing, where
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures.index_text import REST, resolved


@dataclass(frozen=True)
class DrawnSearch:
    """title: the scene's name; result: its numbers and arrays; a: m; along: title of the axis along x; depth: µm, of the layer
    that is wanted beside the surface, or None (the worst one); whose: what passes, in words; part: the DrawnSearch of the
    resolved part, on which the answer rests, None where it is all or has no arrays; when: the moments in words, "" where there
    is no part."""

    title: str
    result: SearchResult
    a: float
    along: str
    depth: float | None = None
    whose: str = "feature"
    part: Any = None
    when: str = ""

    @classmethod
    def of(cls, scene, result, depth=None):
        """Data of a search of a scene, with its resolved part."""
        body = f", body {result.numbers['surface']}" if result.other else ""
        name = scene.name + body + ", pressure alone" * bool(why_none(result.summary))
        a, along, whose = Scales.of(scene).a, from_centre(scene, result.numbers.get("carries_feature", True)), passing(scene)
        known = result.part
        part = cls(name, known, a, along, depth, whose, when=resolved(known.summary, where(scene))
                   ) if known and known.Fi is not None else None
        return cls(name, result, a, along, depth, whose, part, REST if part else "")

    @property
    def summary(self):
        return self.result.numbers

    @property
    def constants(self):
        """Scene, criterion and its numbers, moments where not all count alike, in words."""
        f, when = self.summary, f"; {self.when}" if self.when else ""
        when = ", at the surface" * (self.result.limit_under_row is not None) + when
        return f"{self.title}: {f['criterion']}, κ = {f['kappa_F']:.4g}, σ_eF = {f['sigma_eF_Pa'] / 1e6:.4g} MPa{when}"

    @property
    def each(self):
        """The searches that are shown; the search that decides the verdict stands first."""
        return [self.part, self] if self.part else [self]

    @property
    def one_row(self):
        return self.result.feature_frame_y.size == 1


def beside_worst(depths, worst):
    """Which of the depths whose points were all searched lies next to the worst (m); the surface, their first, apart."""
    return 1 + int(np.argmin(np.abs(depths[1:] - worst)))
