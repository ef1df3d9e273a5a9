"""Pressure and film of a zoom window along a row, over those of its run."""

import numpy as np

THICK, NODES = 1.6, 2.0  # points: width of the lines, size of a node


class ZoomLines:
    """The window of the run in a store along the row of that number; its arrays are read once for all moments."""

    def __init__(self, store, row):
        self.entries, self.line = store.map("zoom_entry"), None
        if self.entries is None:
            return
        rows = store.map("zoom_y")
        line = int(np.argmin(np.abs(rows - store.y[row])))
        if abs(rows[line] - store.y[row]) > 1e-3 * abs(store.x[1] - store.x[0]):
            return
        self.line, self.left, self.x = line, store.map("zoom_left"), store.map("zoom_x")
        self.p, self.h = (store.map(f"zoom_{name}")[:, :, line] for name in ("pressure", "film"))

    def draw(self, axes, entry, a, colour):
        """Draw an entry of the run into the axes of pressure (GPa) and film (µm) over x/a. Returns whether it has a window."""
        if self.line is None or entry not in self.entries:
            return False
        n = int(np.flatnonzero(self.entries == entry)[0])
        for ax, values in zip(axes, (self.p[n] / 1e9, self.h[n] * 1e6)):
            ax.plot((self.left[n] + self.x) / a, values, color=colour, lw=THICK, marker=".", ms=NODES, zorder=4)
        return True
