"""Fatigue search as drawn in figures: of the whole passage, and of its resolved part if that is only a part."""

from dataclasses import dataclass
from typing import Any

from tehl_taichi.fatigue.judged_layers import deciding
from tehl_taichi.fatigue.pressure_alone import why_none
from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.scene.feature_wording import feature_word, from_centre, position_title, position_word
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.values.units import amount
from tehl_taichi.view.figures.index_text import REST, resolved_words


def in_micrometres(depth):
    """A depth in µm, also of a text with a unit; None: no choice. Raises SceneError."""
    if depth is not None:
        depth = amount("depth", depth, "µm", 0.01, 3e4, usual=100.0)
    return depth


@dataclass(frozen=True)
class DrawnSearch:
    """title: name of the scene; result: numbers and arrays; a: m; along: title of the axis along x; depth: µm, of the layer to
    show besides the surface, or None (the worst); whose: text of the passing feature; part: DrawnSearch of the resolved part,
    or None; when: text of the moments, "" without a part; early: whether the verdict rests on the resolved part; positions:
    title of the axis of feature positions.
    """

    title: str
    result: SearchResult
    a: float
    along: str
    depth: float | None = None
    whose: str = "feature"
    part: Any = None
    when: str = ""
    early: bool = True
    positions: str = "position of the feature x / a"

    @classmethod
    def of(cls, scene, result, depth=None):
        """Data of a search of a scene, with its resolved part."""
        depth = in_micrometres(depth)
        body = f", body {result.numbers['surface']}" if result.other else ""
        name = scene.name + body + ", pressure alone" * bool(why_none(result.summary))
        along = from_centre(scene, result.numbers.get("carries_feature", True))
        a, whose = Scales.of(scene).a, feature_word(scene)
        known = result.part
        part = cls(name, known, a, along, depth, whose, when=resolved_words(known.summary, position_word(scene)),
                   positions=position_title(scene)) if known and known.Fi is not None else None
        return cls(name, result, a, along, depth, whose, part, REST if part else "", deciding(result.summaries)[1],
                   position_title(scene))

    @property
    def summary(self):
        return self.result.numbers

    @property
    def constants(self):
        """Text of the scene, the criterion, its numbers, and the moments if not all count."""
        f, when = self.summary, f"; {self.when}" if self.when else ""
        when = ", at the surface" * (self.result.limit_under_row is not None) + when
        return f"{self.title}: {f['criterion']}, κ = {f['kappa_F']:.4g}, σ_eF = {f['sigma_eF_Pa'] / 1e6:.4g} MPa{when}"

    @property
    def each(self):
        """Searches to show; the one that decides the verdict is first."""
        both = [self.part, self] if self.early else [self, self.part]
        return both if self.part else [self]

    @property
    def one_row(self):
        return self.result.feature_frame_y.size == 1


def beside_worst(depths, worst):
    """Number of the searched depth next to the worst one (m), except the surface."""
    return 1 + nearest_index(depths[1:], worst)
