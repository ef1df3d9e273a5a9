"""Result of a fatigue search: its numbers and arrays, and their names in a store."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

from tehl_taichi.fatigue.judged_layers import first_decides
from tehl_taichi.fatigue.pressure_alone import constants_of, searched

BOTH = ("feature_frame_x", "feature_frame_y")
ROWS = "depths of rows"  # stands for fatigue_depth, or under_row_depth where depths are listed
ARRAYS = {  # {name: (dimensions, unit, text)}, in the order of a store
    "feature_frame_x": (BOTH[:1], "m", "along rolling, as feature.x"),
    "feature_frame_y": (BOTH[1:], "m", "across, as feature.y, from the middle of the contact"),
    "findley_stress": (BOTH, "Pa", "Findley stress"),
    "Fi": (BOTH, "1", "Findley index"),
    "sigma1_max": (BOTH, "Pa", "largest principal stress of the passage"),
    "plane_theta": (BOTH, "degree", "angle of the critical plane's normal from the surface normal"),
    "plane_phi": (BOTH, "degree", "direction of the critical plane's normal in the surface, from x"),
    "passed": (BOTH, "1", "points of the whole surface that this one stands for, 0 where no feature passes"),
    "under_row_depth": (("under_row_depth",), "m", "below the surface"),
    "fatigue_depth": (("fatigue_depth",), "m", "below the surface"),
    "findley_stress_under_row": ((ROWS, BOTH[0]), "Pa", "Findley stress below the row of the critical point below the surface"),
    "findley_stress_contact_alone": ((ROWS,), "Pa", "Findley stress of the contact without its feature"),
    "worst_depth": (("worst_depth",), "m", "below the surface, searched at all points"),
    "findley_stress_at_worst_depth": (BOTH, "Pa", "Findley stress at that depth"),
    "findley_stress_at_depth": (("fatigue_depth", *BOTH), "Pa", "Findley stress"),
    "limit_under_row": ((ROWS,), "Pa", "fatigue limit"),
    "limit_at_worst_depth": (("worst_depth",), "Pa", "fatigue limit"),
    "limit_at_depth": (("fatigue_depth",), "Pa", "fatigue limit")}
LIMITS = {"findley_stress_under_row": "limit_under_row", "findley_stress_contact_alone": "limit_under_row",
          "findley_stress_at_worst_depth": "limit_at_worst_depth", "findley_stress_at_depth": "limit_at_depth"}
HISTORIES = {"worst": "the critical point at the surface", "worst_below": "the critical point below the surface"}
HISTORY = {  # {key: (dimensions, unit, text)} of a stress history
    "x_a": (("moment",), "m", "centre of the feature; the last moment is unloaded"),
    "stress": (("moment", "component"), "Pa", "xx, yy, zz, xy, xz, yz at {point}"),
    "normal": (("direction",), "1", "unit normal of its critical plane"),
    "circle": (("of_circle",), "Pa", "around its shear path: centre along dip, strike; radius")}
PART, PART_TEXT = "resolved_", " while the grid resolves the pressure"  # of arrays of the resolved part
OWN = ("moment", "worst_depth")  # dimensions that the resolved part does not share with the whole passage
SHARED = (*BOTH, "passed", "under_row_depth", "fatigue_depth",
          "findley_stress_contact_alone", "limit_under_row", "limit_at_depth")  # arrays of the whole that it shares
OTHER, EQUAL = "other_", ("component", "direction", "of_circle")  # of arrays of the other body; dimensions equal in both


@dataclass(frozen=True, eq=False)
class SearchResult:
    """Result of a fatigue search; an array is None where it was not computed.

    Attributes
    ----------
    summary : dict
        Numbers in SI units, at the surface, and below it in its "below"; "surface": the searched body, "a" or "b".
    feature_frame_x, feature_frame_y : numpy.ndarray
        Points of the surface, m: from the centre of its feature, or from the place that a feature of the other body meets at
        X = 0.
    findley_stress, Fi, sigma1_max, plane_theta, plane_phi : numpy.ndarray
        At the surface, (x, y).
    passed : numpy.ndarray
        Number of points of the whole surface that this one represents in statistics, (x, y); 0 where no feature passes.
    fatigue_depth, under_row_depth : numpy.ndarray
        Depths searched, m; `under_row_depth`: those under a row, where other depths were listed.
    findley_stress_under_row, findley_stress_contact_alone : numpy.ndarray
        Over `row_depths`: under the row of the critical point (depth, x), and of the contact without its feature (depth,).
    worst_depth, findley_stress_at_worst_depth : numpy.ndarray
        The depth (1,) whose points were all searched, and the stress there (x, y).
    findley_stress_at_depth : numpy.ndarray
        At all points of the depths listed, (depth, x, y).
    limit_under_row, limit_at_worst_depth, limit_at_depth : numpy.ndarray
        Fatigue limit at these depths, Pa; None if the limit of the summary holds at all depths.
    worst, worst_below : dict
        Stress history of the critical point of the surface, and of that below: x_a (m), stress (times, 6) Pa, the last one
        unloaded, normal (3,), circle around the shear path (centre along dip and strike, radius; Pa).
    resolved : SearchResult
        Search of the moments while the grid resolves the pressure; None if it resolves all.
    other : SearchResult
        Search of the other body, which does not decide the verdict; None if one body was searched.

    Examples
    --------
    >>> import tehl_taichi as tehl
    >>> tehl.SearchResult({"Fi_max": 0.97, "below": {"Fi_max": 1.21}})
    <tehl.SearchResult: Fi_max 0.97 at the surface, 1.21 below>
    """

    summary: dict
    feature_frame_x: Any = None
    feature_frame_y: Any = None
    findley_stress: Any = None
    Fi: Any = None
    sigma1_max: Any = None
    plane_theta: Any = None
    plane_phi: Any = None
    passed: Any = None
    under_row_depth: Any = None
    fatigue_depth: Any = None
    findley_stress_under_row: Any = None
    findley_stress_contact_alone: Any = None
    worst_depth: Any = None
    findley_stress_at_worst_depth: Any = None
    findley_stress_at_depth: Any = None
    limit_under_row: Any = None
    limit_at_worst_depth: Any = None
    limit_at_depth: Any = None
    worst: dict | None = None
    worst_below: dict | None = None
    resolved: "SearchResult | None" = None
    other: "SearchResult | None" = None

    @classmethod
    def from_arrays(cls, searches, array, first=""):
        """SearchResult of a store: {surface: summary of its search}, as they were stored, and array(name): an array or None."""
        summary, *others = searches.values()
        known = searched(summary).get("resolved")
        part = cls(known, **_named(array, first + PART)) if known else None
        other = cls.from_arrays({"": others[0]}, array, OTHER) if others else None
        return cls(summary, **_named(array, first), resolved=part, other=other)

    @classmethod
    def joined(cls, results: "Iterable[SearchResult]") -> "SearchResult":
        """The first SearchResult of one or two (a list), with the other one in it."""
        first, *others = results
        return replace(first, other=replace(others[0], other=None) if others else None)

    def decided(self) -> "SearchResult":
        """Result with the body first that decides the verdict, by the errors that are known so far."""
        each = self.by_surface
        return self.joined([each[name] for name in first_decides(self.summaries)])

    def with_summaries(self, summaries: dict[str, dict]) -> "SearchResult":
        """Result with other {surface: summary}."""
        return self.joined([replace(one, summary=summaries[name]) for name, one in self.by_surface.items()])

    def to_arrays(self):
        """{name: (values, dimensions, unit, text)} for a store."""
        rows = "fatigue_depth" if self.under_row_depth is None else "under_row_depth"
        own = _arrays(self, rows) | (_of_part(_arrays(self.resolved, rows)) if self.resolved else {})
        return own | (_of_other(self.other.to_arrays()) if self.other else {})

    @property
    def by_surface(self) -> dict[str, "SearchResult"]:
        """{"a" or "b": SearchResult} of each searched body, this one first."""
        return {one.summary.get("surface", "a"): one for one in (self, self.other) if one}

    @property
    def summaries(self) -> dict[str, dict]:
        """{"a" or "b": summary} of each searched body, this one first."""
        return {name: one.summary for name, one in self.by_surface.items()}

    @property
    def maps(self) -> dict:
        """Same as :meth:`to_arrays`."""
        return self.to_arrays()

    @property
    def numbers(self) -> dict:
        """Numbers of this search; if the summary gives no index, those of the pressure alone."""
        return searched(self.summary)

    def index(self, name):
        """Index of the stresses `name`, by the limit of their depth; None without such stresses."""
        stress, limits = getattr(self, name), getattr(self, LIMITS[name])
        if stress is None:
            return None
        if limits is None:
            return stress / self.numbers["sigma_eF_Pa"]
        own = stress.reshape(len(limits), -1) / limits[:, None]
        return own.reshape(stress.shape)

    @property
    def row_depths(self):
        """Depths (m) of the stresses below a row."""
        return self.fatigue_depth if self.under_row_depth is None else self.under_row_depth

    @property
    def part(self):
        """Resolved part with the constants and places of the whole passage, or None."""
        if self.resolved is None:
            return None
        return replace(self.resolved, summary={**constants_of(self.numbers), **self.numbers["resolved"]},
                       **{name: getattr(self, name) for name in SHARED})

    def __repr__(self):
        found = self.numbers
        below = f", {found['below']['Fi_max']:.3g} below" if "below" in found else ""
        return f"<tehl.SearchResult: Fi_max {found['Fi_max']:.3g} at the surface{below}>"


def _named(array, first):
    """{field: value} of arrays whose names begin with `first`."""
    found = {name: array(first + name) for name in ARRAYS}
    for point in HISTORIES:
        history = {key: array(f"{first}{point}_{key}") for key in HISTORY}
        found[point] = None if history["stress"] is None else history
    return found


def _arrays(result, rows):
    """Arrays of a result by name, without those of its resolved part; rows: dimension of the stresses below a row."""
    found = {name: (getattr(result, name), [rows if dim == ROWS else dim for dim in dims], unit, text)
             for name, (dims, unit, text) in ARRAYS.items()}
    for point, words in HISTORIES.items():
        found |= {f"{point}_{key}": (history[key], list(dims), unit, text.format(point=words))
                  for key, (dims, unit, text) in HISTORY.items() if (history := getattr(result, point))}
    return {name: array for name, array in found.items() if array[0] is not None}


def _of_part(arrays):
    """Arrays of a resolved part by their names in a store."""
    return {PART + name: (values, [PART + dim if dim in OWN else dim for dim in dims], unit, text + PART_TEXT)
            for name, (values, dims, unit, text) in arrays.items()}


def _of_other(arrays):
    """Arrays of the other body by their names in a store."""
    return {OTHER + name: (values, [dim if dim in EQUAL else OTHER + dim for dim in dims], unit, f"{text}; other body")
            for name, (values, dims, unit, text) in arrays.items()}
