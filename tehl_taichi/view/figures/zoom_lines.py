"""Pressure and film of a zoom window along a row, drawn over those of its run."""

from tehl_taichi.view.zoom_window import ZoomWindow

THICK, NODES = 1.6, 2.0  # points: width of the lines, size of a node


class ZoomLines:
    """Zoom window of the run in a store, along the given row."""

    def __init__(self, store, row):
        self.window = ZoomWindow.of(store)
        self.line = self.window and self.window.row(store.y[row])

    def draw(self, axes, entry, a, colour):
        """Draw an entry of the run into the axes of pressure (GPa) and film (µm) over x/a. Returns whether it has a window."""
        if self.line is None or entry not in self.window:
            return False
        x, found = self.window.columns(entry) / a, self.window.fields(entry, ("pressure", "film"))
        for ax, values in zip(axes, (found["pressure"] / 1e9, found["film"] * 1e6)):
            ax.plot(x, values[:, self.line], color=colour, lw=THICK, marker=".", ms=NODES, zorder=4)
        return True
