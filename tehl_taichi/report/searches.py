"""Fatigue searches shown on a page: of the resolved part of the passage and of the whole, the one that decides first."""

from dataclasses import dataclass
from functools import cached_property

from tehl_taichi.fatigue.judged_layers import deciding
from tehl_taichi.fatigue.judged_surfaces import by_surface
from tehl_taichi.fatigue.pressure_alone import why_none
from tehl_taichi.fatigue.search_result import SearchResult
from tehl_taichi.report import numbered_points
from tehl_taichi.report.scene_text import when
from tehl_taichi.scene import Scene
from tehl_taichi.scene.feature_wording import from_centre, position_word
from tehl_taichi.view.figures.index_text import PART, resolved_words


@dataclass(frozen=True)
class Search:
    """when: text of its moments; on: start of the names of its figures; short: short text of the moments, "" if there is only
    one search.
    """

    scene: Scene
    result: SearchResult
    when: str
    on: str = ""
    short: str = ""

    @property
    def along(self):
        """Title of the axis along its surface."""
        return from_centre(self.scene, self.result.numbers.get("carries_feature", True))

    @cached_property
    def places(self):
        """Its worst places, see :func:`tehl_taichi.report.numbered_points.places`; used in two maps and a table."""
        return numbered_points.places(self)


def searches(store, result=None):
    """[:class:`Search`] of the whole passage and, if the grid does not resolve every pressure, of the resolved part; that which
    decides is first. result: of the search, by default that of the store.
    """
    scene, result = store.scene, result or SearchResult.from_arrays(by_surface(store.summary), store.map)
    body = f", body {result.numbers['surface']}, the worse one" if result.other else ""
    over = when(scene) + body + ", pressure alone" * bool(why_none(result.summary))
    if not (part := result.part):
        return [Search(scene, result, over)]
    both = [Search(scene, part, resolved_words(part.summary, position_word(scene)), "resolved-", PART),
            Search(scene, result, f"{over}, later pressures not resolved by the grid", short=over)]
    return both if deciding(result.summaries)[1] else both[::-1]
