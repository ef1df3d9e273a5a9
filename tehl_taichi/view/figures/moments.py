"""Moments of a run shown in figures, and their texts."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.feature_wording import position_word
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.values.units import amount
from tehl_taichi.view.figures import palette

POSITIONS = (-0.8, 0.0, 0.8)  # of the feature, a: shown by default
NEAR, ALIKE = 0.1, 0.95       # a, and of the largest pressure: a moment so close to it, with so much of it, shows it
BEYOND = 0.05                 # a: as far beyond the stored positions a moment may be requested
WINDOW = (-1.6, 1.4)          # x / a shown: the contact and what is close to it
INSIDE = 0.9                  # a: there the film's axis shows all of the film
ROOM = 2.5                    # of the central film: upper end of the film's axis, below the gap outside


@dataclass(frozen=True)
class Moments:
    """Moments of the run in `store`; at: only this position of the feature, in a, or None. Raises SceneError if the feature is
    never there.
    """

    store: Any
    at: float | None = None

    def __post_init__(self):
        if self.at is None:
            return
        if self.store.steps < 2:
            raise SceneError(f"at = {self.at} a is a position of the feature, but {self.store.path} has only a steady state")
        low, high = self.moved.min(), self.moved.max()
        at = amount("at", self.at, "a", round(low - BEYOND, 2), round(high + BEYOND, 2))
        object.__setattr__(self, "at", at)

    @cached_property
    def a(self):
        """Half-width of the contact, m."""
        return Scales.of(self.store.scene).a

    @property
    def named(self):
        """Name of the scene with the length in which axes count, such as "gear (a = 0.362 mm)"."""
        return f"{self.store.scene.name} (a = {1e3 * self.a:.3g} mm)"

    @cached_property
    def moved(self):
        """Centre of the feature over a, at every entry after the steady start."""
        return self.store.scalar("feature_x")[1 : self.store.steps] / self.a

    @cached_property
    def x(self):
        """x / a."""
        return self.store.x / self.a

    @property
    def row(self):
        """Row of y = 0, used to compare runs."""
        return nearest_index(self.store.y, 0.0)

    @property
    def worst(self):
        """Entry with the largest pressure: of the passage, if there is one."""
        p = self.store.scalar("p_max_Pa")
        return int(np.argmax(p[1:])) + 1 if len(p) > 1 else 0

    @property
    def half(self):
        """Whether the row y = 0 suffices: in one dimension, on a half domain, and in a steady contact of smooth surfaces."""
        return self.store.y[0] >= 0 or self.store.steps < 2

    @cached_property
    def line(self):
        """Row of the lines along x: y = 0; for a passage on the whole domain the row of its largest pressure.

        Along y = 0 a measured surface would often show only lower peaks. Rows at the rim of a map are excluded.
        """
        if self.half:
            return self.row
        p = self._pressures
        return int(np.argmax(np.where(self._away, p, -1.0))) if self._away.any() else int(np.argmax(p))

    @cached_property
    def _pressures(self):
        """Largest pressure (Pa) of every row at the moment of the largest pressure."""
        return self.store.fields(self.worst, ["pressure"])["pressure"].max(axis=0)

    @cached_property
    def _away(self):
        """Mask of rows outside the fading rim of measured maps, whose heights are not those of the surface."""
        rims = [(f, f.to_rim(0.0, self.store.y - f.y)[1]) for f in self.store.scene.features if f.kind.measured]
        return np.all([np.full(self.store.y.size, True), *((rim < 0) | (rim > f.taper) for f, rim in rims)], axis=0)

    @property
    def along(self):
        """Text of the place of the line."""
        store = self.store
        if store.y.size == 1:
            return "along x"
        if self.half:
            return "along y = 0"
        rest = "" if self._away.all() or self._pressures[self.line] >= self._pressures.max() else " away from the scan's rim"
        return f"along y = {round(float(store.y[self.line]) * 1e6)} µm, through the largest pressure{rest}"

    @property
    def window(self):
        """(left, right) in a of the range shown along x, including the feature."""
        at = 0.0 if self.at is None else self.at
        return max(min(WINDOW[0], at - 0.4), self.x[0]), min(max(WINDOW[1], at + 0.4), self.x[-1])

    def nearest(self, position):
        """Entry with the feature nearest to `position` (a); the steady one without a passage."""
        return 1 + nearest_index(self.moved, position) if self.store.steps > 1 else 0

    @cached_property
    def placed(self):
        """Entries with the feature at the positions."""
        positions = POSITIONS if self.at is None else (self.at,)
        low, high = self.moved.min() - BEYOND, self.moved.max() + BEYOND
        return list(dict.fromkeys(self.nearest(position) for position in positions if low <= position <= high))

    @cached_property
    def missed(self):
        """[entry of the largest pressure] if none of those entries shows its peak; [] if a position was chosen."""
        p, at = self.store.scalar("p_max_Pa"), self.moved
        shown = any(abs(at[n - 1] - at[self.worst - 1]) <= NEAR and p[n] >= ALIKE * p[self.worst] for n in self.placed)
        return [] if shown or self.at is not None else [self.worst]

    def several(self):
        """{entry: (colour, text)} for lines: the steady start in grey, then the positions and the largest pressure; equal in
        every figure.
        """
        if self.store.steps < 2:
            return {0: (palette.LINES[0], self.says(0))}
        colours = {0: palette.GREY, **dict(zip([*self.placed, *self.missed], palette.LINES))}
        return {n: (colour, "largest pressure: " * (n in self.missed) + self.says(n)) for n, colour in colours.items()}

    def one(self):
        """Entry of maps: the feature nearest to the middle, or at the chosen position."""
        return self.nearest(0.0 if self.at is None else self.at)

    def says(self, n):
        """Description of entry n."""
        if n == 0:
            return "steady start" if self.store.steps > 1 else "steady"
        return f"{position_word(self.store.scene)} at {self._position(n)}"

    def _position(self, n):
        return f"{self.moved[n - 1]:+.2f} a".replace("-0.00", "+0.00")

    def peak(self, n):
        """Description of entry n with its largest pressure and, if another moment has a larger one, that of the passage."""
        p, worst = (round(float(self.store.fields(k, ["pressure"])["pressure"].max()) / 1e9, 2) for k in (n, self.worst))
        more = f" ({worst:.2f} at {self._position(self.worst)})" if worst > p else ""
        return f"{self.says(n)}, p_max {p:.2f} GPa{more}"

    def film_top(self, entries):
        """Upper end (m) of the film's axis: well above the central film and above the film inside a feature."""
        inside = np.abs(self.x) < INSIDE
        deepest = max(float(self.store.fields(n, ["film"])["film"][inside, self.line].max()) for n in entries)
        return max(ROOM * float(self.store.scalar("h_c_m")[0]), 1.1 * deepest)
