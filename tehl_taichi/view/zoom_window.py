"""Fine window of a stored run, by moment."""

from functools import cached_property

import numpy as np

from tehl_taichi.march.zoom.zoomed_reader import EXTREMES

__all__ = ["EXTREMES", "FIRST", "ZoomWindow"]
ALONG = "zoom_moment", "zoom_x", "zoom_y"  # dimensions of its fields
FIRST = "zoom_"  # begins their names


class ZoomWindow:
    """Zoom window of the run in `store`.

    entries: numbers of the run's entries with a window; x: distances (m) from the first column of the window; y: m; lefts:
    position of the first column at each entry, m.
    """

    def __init__(self, store):
        self.store, self.entries = store, store.map("zoom_entry").astype(int)
        self.lefts, self.x, self.y = (store.map(f"zoom_{name}") for name in ("left", "x", "y"))
        self.place, self.read = {int(entry): n for n, entry in enumerate(self.entries)}, {}

    @classmethod
    def of(cls, store):
        """Window of a stored run; None without one."""
        return cls(store) if store.map("zoom_entry") is not None else None

    def __contains__(self, entry):
        return int(entry) in self.place

    @cached_property
    def names(self):
        """Names of its fields, equal to those of the run."""
        return [name.removeprefix(FIRST) for name, array in self.store.metadata.items()
                if tuple(array["dimension_names"]) == ALONG]

    @cached_property
    def worst(self):
        """Entry of the run with the largest pressure in the window."""
        return int(self.entries[np.argmax(self.extremes("p_max_Pa"))])

    @property
    def between(self):
        """Its moments between the entries: (places between the entries (n,), positions of the first column (n,) m, list of
        {name: (columns, rows)})."""
        at = self.store.map("zoom_between_entry")
        if at is None:
            return np.zeros(0), np.zeros(0), []
        found = {name: self.store.map(f"zoom_between_{name}") for name in self.names}
        parts = [{name: values[n] for name, values in found.items() if values is not None} for n in range(at.size)]
        return at, self.store.map("zoom_between_left"), parts

    def _moments(self, name):
        """A field at all entries, read once."""
        if name not in self.read:
            self.read[name] = self.store.map(FIRST + name)
        return self.read[name]

    def columns(self, entry):
        """Positions (m) of its columns at one of its entries."""
        return self.lefts[self.place[int(entry)]] + self.x

    def fields(self, entry, names=None):
        """{name: (columns, rows)} of the available ones of these fields (default: all) at an entry of the run, SI."""
        shown = self.names if names is None else [name for name in names if name in self.names]
        return {name: self._moments(name)[self.place[int(entry)]] for name in shown}

    def extremes(self, name):
        """One of EXTREMES at each entry, of the window alone."""
        field, extreme = EXTREMES[name]
        return extreme(self._moments(field), axis=(1, 2))

    def row(self, y):
        """Number of the window's row at y (m); None if the window has no row there."""
        row = int(np.argmin(np.abs(self.y - y)))
        return row if abs(self.y[row] - y) < 1e-3 * (self.x[1] - self.x[0]) else None
