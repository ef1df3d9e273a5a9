"""What a fatigue search found, as figures take it: of the whole passage, and of its resolved part where it is not all."""

from dataclasses import dataclass
from typing import Any

from tehl_taichi.fatigue.pressure_alone import searched, why_none
from tehl_taichi.scene.feature_wording import from_centre, passing, where
from tehl_taichi.scene.scales import Scales
from tehl_taichi.view.figures.index_text import REST, resolved

OF_PART = "resolved_"  # begins the names of the part's maps
DEPTHS = ("fatigue_depth", "under_row_depth")
# maps that both share: places, and the contact alone, which has not yet loaded a point by the end of a part of its passage
SHARED = ("feature_frame_x", "feature_frame_y", *DEPTHS, "findley_stress_contact_alone")
RESULTS = ("Fi", "findley_stress_at_depth", "findley_stress_under_row", "worst_depth", "findley_stress_at_worst_depth")
HISTORY = ("x_a", "stress", "normal", "circle")
HISTORIES = {"surface": "worst", "below": "worst_below"}
MAPS = (*SHARED, *(first + name for first in ("", OF_PART)
                   for name in (*RESULTS, *(f"{of}_{part}" for of in HISTORIES.values() for part in HISTORY))))  # those found
CONSTANTS = ("criterion", "kappa_F", "sigma_eF_Pa")


@dataclass(frozen=True)
class DrawnSearch:
    """title: the scene's name; maps: {name of MAPS: array} found; points: {"surface": history, "below": the same or None};
    summary: of a FatigueResult; a: m; along: title of the axis along x; depth: µm, of the layer that is wanted beside the
    surface, or None (the worst one); whose: what passes, in words; part: the DrawnSearch of the resolved part, on which the
    answer rests, None where it is all or has no maps; when: the moments in words, "" where there is no part."""

    title: str
    maps: dict
    points: dict
    summary: dict
    a: float
    along: str
    depth: float | None = None
    whose: str = "feature"
    part: Any = None
    when: str = ""

    @classmethod
    def of(cls, scene, maps, summary, depth=None):
        """Of a search of a scene, with its maps and those of its part."""
        name = f"{scene.name}, pressure alone" if why_none(summary) else scene.name
        common, summary = (name, Scales.of(scene).a, from_centre(scene), depth, passing(scene)), searched(summary)
        known = summary.get("resolved")
        part = _of(common, _part(maps), {**{key: summary[key] for key in CONSTANTS}, **known},
                   when=resolved(known, where(scene))) if known and OF_PART + "Fi" in maps else None
        return _of(common, maps, summary, part=part, when=REST if part else "")

    @property
    def constants(self):
        """Scene, criterion and its numbers, moments where not all count alike, in words."""
        f, when = self.summary, f"; {self.when}" if self.when else ""
        return f"{self.title}: {f['criterion']}, κ = {f['kappa_F']:g}, σ_eF = {f['sigma_eF_Pa'] / 1e6:.4g} MPa{when}"

    @property
    def each(self):
        """The searches that are shown, that on which the answer rests first."""
        return [self.part, self] if self.part else [self]

    @property
    def one_row(self):
        return self.maps["feature_frame_y"].size == 1


def _of(common, maps, summary, **more):
    title, a, along, depth, whose = common
    points = {which: _history(maps, name) for which, name in HISTORIES.items()}
    return DrawnSearch(title, maps, points, summary, a, along, depth, whose, **more)


def _part(maps):
    """Those of the part, under the names that they have of the whole."""
    own = {name.removeprefix(OF_PART): values for name, values in maps.items() if name.startswith(OF_PART)}
    return own | {name: maps[name] for name in SHARED if name in maps}


def _history(maps, name):
    """History of a worst point, or None."""
    return {part: maps[f"{name}_{part}"] for part in HISTORY} if f"{name}_stress" in maps else None
