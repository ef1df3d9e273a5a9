"""Fine windows of a stored run, by moment."""

from functools import cached_property

import numpy as np

from tehl_taichi.march.zoom import overlap
from tehl_taichi.march.zoom.window import windows_of
from tehl_taichi.march.zoom.zoomed_reader import EXTREMES
from tehl_taichi.scene.scales import Scales
from tehl_taichi.values.arrays import nearest_index

__all__ = ["EXTREMES", "FIRST", "ZoomWindow"]
FIRST = "zoom_", "zoom2_"  # begin the names of the windows of a run: of the first feature's surface, and of the other one


class ZoomWindow:
    """Zoom window of the run in `store`; first: beginning of its names.

    entries: numbers of the run's entries with a window; x: distances (m) from the first column of the window; y: m; lefts:
    position of the first column at each entry, m.
    """

    def __init__(self, store, first=FIRST[0]):
        self.store, self.first, self.entries = store, first, store.map(f"{first}entry").astype(int)
        self.lefts, self.x, self.y = (store.map(first + name) for name in ("left", "x", "y"))
        self.place, self.read = {int(entry): n for n, entry in enumerate(self.entries)}, {}

    @classmethod
    def of(cls, store):
        """First window of a stored run; None without one."""
        return next(iter(cls.all_of(store)), None)

    @classmethod
    def all_of(cls, store):
        """List of the windows of a stored run."""
        return [cls(store, first) for first in FIRST if store.map(f"{first}entry") is not None]

    @classmethod
    def with_most(cls, store):
        """The window with the largest pressure; None without one."""
        found = [window for window in cls.all_of(store) if window.entries.size]
        return max(found, key=lambda window: window.extremes("p_max_Pa").max(), default=None)

    def __contains__(self, entry):
        return int(entry) in self.place

    @cached_property
    def names(self):
        """Names of its fields, equal to those of the run."""
        along = tuple(f"{self.first}{axis}" for axis in ("moment", "x", "y"))
        return [name.removeprefix(self.first) for name, array in self.store.metadata.items()
                if tuple(array["dimension_names"]) == along]

    @property
    def number(self):
        """Number of the second window, as the end of a text: " 2"; "" for the first one."""
        return f" {FIRST.index(self.first) + 1}" if self.first != FIRST[0] else ""

    @cached_property
    def worst(self):
        """Entry of the run with the largest pressure in the window."""
        return int(self.entries[np.argmax(self.extremes("p_max_Pa"))])

    @property
    def between(self):
        """Its moments between the entries: (places between the entries (n,), positions of the first column (n,) m, list of
        {name: (columns, rows)})."""
        between = f"{self.first}between_"
        at = self.store.map(f"{between}entry")
        if at is None:
            return np.zeros(0), np.zeros(0), []
        found = {name: self.store.map(between + name) for name in self.names}
        parts = [{name: values[n] for name, values in found.items() if values is not None} for n in range(at.size)]
        return at, self.store.map(f"{between}left"), parts

    def _moments(self, name):
        """A field at all entries, read once."""
        if name not in self.read:
            self.read[name] = self.store.map(self.first + name)
        return self.read[name]

    def columns(self, entry):
        """Positions (m) of its columns at one of its entries."""
        return self.lefts[self.place[int(entry)]] + self.x

    def fields(self, entry, names=None):
        """{name: (columns, rows)} of the available ones of these fields (default: all) at an entry of the run, SI."""
        shown = self.names if names is None else [name for name in names if name in self.names]
        return {name: self._moments(name)[self.place[int(entry)]] for name in shown}

    def extremes(self, name):
        """One of EXTREMES at each entry, of the window alone: where it overlaps another one, of the nodes that belong to it."""
        field, extreme = EXTREMES[name]
        moments = zip(self.entries, self._moments(field))
        return np.array([extreme(values[self.own(entry)]) for entry, values in moments])

    def own(self, entry):
        """Mask (columns, rows) of its nodes that belong to it at an entry of the run: all, without another window."""
        others = [one._placed(entry) for one in self.others if entry in one]
        return overlap.inside(self._placed(entry), others).T if others else np.ones((self.x.size, self.y.size), bool)

    @cached_property
    def others(self):
        """List of the other windows of the run."""
        return [one for one in self.all_of(self.store) if one.first != self.first]

    def _placed(self, entry):
        """The PlacedWindow at an entry of the run."""
        X = float(self.store.feature_x(int(entry))) / Scales.of(self.store.scene).a
        return overlap.PlacedWindow.of(self.place_on_grid, X, self.origins(self.lefts[self.place[int(entry)]]))

    @cached_property
    def place_on_grid(self):
        """Its :class:`tehl_taichi.march.zoom.window.Window`."""
        return windows_of(self.store.scene, self.store.scene.zoom.factor)[FIRST.index(self.first)]

    def origins(self, lefts):
        """Numbers of the first fine columns at these positions (m)."""
        fine = (self.store.x[1] - self.store.x[0]) / self.place_on_grid.factor
        return np.round((lefts - self.store.x[0]) / fine).astype(int)

    def row(self, y):
        """Number of the window's row at y (m); None if the window has no row there."""
        row = nearest_index(self.y, y)
        return row if abs(self.y[row] - y) < 1e-3 * (self.x[1] - self.x[0]) else None
