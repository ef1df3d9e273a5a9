"""The fine window of a stored run, moment by moment."""

from functools import cached_property

import numpy as np

from tehl_taichi.march.zoom.zoomed_reader import EXTREMES

__all__ = ["EXTREMES", "FIRST", "ZoomWindow"]
ALONG = "zoom_moment", "zoom_x", "zoom_y"  # dimensions of its fields
FIRST = "zoom_"  # begins their names


class ZoomWindow:
    """What the window of the run in `store` has: `entries` of the run, distances `x` from its first column and `y` (m)."""

    def __init__(self, store):
        self.store, self.entries = store, store.map("zoom_entry").astype(int)
        self.lefts, self.x, self.y = (store.map(f"zoom_{name}") for name in ("left", "x", "y"))
        self.place = {int(entry): n for n, entry in enumerate(self.entries)}

    @classmethod
    def of(cls, store):
        """Window of a stored run; None of a run without one."""
        return cls(store) if store.map("zoom_entry") is not None else None

    def __contains__(self, entry):
        return int(entry) in self.place

    @property
    def names(self):
        """Names of its fields, as those of the run are named."""
        return [name.removeprefix(FIRST) for name, array in self.store.metadata.items()
                if tuple(array["dimension_names"]) == ALONG]

    @cached_property
    def worst(self):
        """Entry of the run at which the window has its largest pressure."""
        return int(self.entries[np.argmax(self.extremes("p_max_Pa"))])

    @cached_property
    def _all(self):
        return {name: self.store.map(FIRST + name) for name in self.names}

    def columns(self, entry):
        """Places of its columns (m) at an entry of the run that it has."""
        return self.lefts[self.place[int(entry)]] + self.x

    def fields(self, entry):
        """{name: (columns, rows)} at an entry of the run that it has, SI."""
        return {name: values[self.place[int(entry)]] for name, values in self._all.items()}

    def extremes(self, name):
        """One of EXTREMES at each of its entries, of the window alone."""
        field, extreme = EXTREMES[name]
        return extreme(self._all[field], axis=(1, 2))

    def row(self, y):
        """Number of its row at a row of the run, at y (m); None where it has none there."""
        row = int(np.argmin(np.abs(self.y - y)))
        return row if abs(self.y[row] - y) < 1e-3 * (self.x[1] - self.x[0]) else None
