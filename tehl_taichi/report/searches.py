"""What a fatigue search found, as pages show it: of the part of the passage on which the answer rests, and of the whole."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from tehl_taichi.fatigue.pressure_alone import searched, why_none
from tehl_taichi.report import numbered_points
from tehl_taichi.report.scene_text import when
from tehl_taichi.scene.feature_wording import where
from tehl_taichi.view.figures.index_text import PART, resolved
from tehl_taichi.view.figures.search_data import CONSTANTS, OF_PART, SHARED


@dataclass(frozen=True)
class Search:
    """store: of the run, or what answers in its place; found: summary of the search; when: its moments, in words; of: begins
    names of its maps, on: of its figures; short: the moments in few words, "" where there is one search only."""

    store: Any
    found: dict
    when: str
    of: str = ""
    on: str = ""
    short: str = ""

    @property
    def scene(self):
        return self.store.scene

    @cached_property
    def places(self):
        """Its worst places, see :func:`tehl_taichi.report.numbered_points.places`: in two maps and a table."""
        return numbered_points.places(self)

    def map(self, name):
        """One of its maps, or None."""
        return self.store.map(name if name in SHARED else self.of + name)


def searches(store):
    """One :class:`Search`, or two: where the grid does not resolve every pressure first that of the part before, on which the
    answer rests."""
    found, over = searched(store.summary["fatigue"]), when(store.scene)
    over += ", pressure alone" * bool(why_none(store.summary["fatigue"]))
    known = found.get("resolved")
    if not known:
        return [Search(store, found, over)]
    part = {**{key: found[key] for key in CONSTANTS}, **known}
    return [Search(store, part, resolved(known, where(store.scene)), OF_PART, "resolved-", PART),
            Search(store, found, f"{over}, later pressures not resolved by the grid", short=over)]
