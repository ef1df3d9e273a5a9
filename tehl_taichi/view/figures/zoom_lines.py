"""Pressure and film of the zoom windows along a row, drawn over those of the run."""

import numpy as np

from tehl_taichi.view.zoom_window import ZoomWindow

THICK, NODES = 1.6, 2.0  # points: width of the lines, size of a node


class ZoomLines:
    """Zoom windows of the run in a store, along the given row; where two overlap, the one that a node belongs to."""

    def __init__(self, store, row):
        rows = [(window, window.row(store.y[row])) for window in ZoomWindow.all_of(store)]
        self.lines = [(window, line) for window, line in rows if line is not None]

    def draw(self, axes, entry, a, colour):
        """Draw an entry of the run into the axes of pressure (GPa) and film (µm) over x/a. Returns whether it has a window."""
        there = [(window, line) for window, line in self.lines if entry in window]
        for window, row in there:
            x, found, own = window.columns(entry) / a, window.fields(entry, ("pressure", "film")), window.own(entry)[:, row]
            for ax, values in zip(axes, (found["pressure"] / 1e9, found["film"] * 1e6)):
                ax.plot(x, np.where(own, values[:, row], np.nan), color=colour, lw=THICK, marker=".", ms=NODES, zorder=4)
        return bool(there)
