"""Windows that overlap: which of them a node belongs to, and the weights of their values.

Both are fine, but what enters a window has the film of the run. So features and oil belong to the window that moves with them.
"""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.march.zoom.window import HALF, Window

SHARP = 4  # power of the nearness to two windows; where it is half of the other, a window has 6 % of a node


@dataclass(frozen=True)
class PlacedWindow:
    """A Window at a moment. origin: its first fine column; at: fine column (with fraction) of the origin of its surface."""

    window: Window
    origin: int
    at: float

    @classmethod
    def of(cls, window, X, origin=None):
        """The window with the first feature at X (a); origin: where it is known, as X of a store may round to its neighbour."""
        origin = window.origin(X) if origin is None else int(origin)
        return cls(window, origin, (window.pace * X - window.x_min) / window.dx)

    def core(self, columns, rows):
        """Weight (rows, columns) of the core at nodes of the fine grid (numbers of columns and rows)."""
        return self.window.core(columns, rows, self.origin)

    def nearness(self, columns, rows):
        """Nearness (rows, columns) of nodes: 1 in the middle of the features of the window, 0 at its border and beyond.

        The grid does not hold this window back at its ends, so features that enter a window there are far from it.
        """
        w, way = self.window, columns - self.at + self.window.back
        along = np.maximum(np.minimum(way / w.middle, (w.nx - way) / (w.nx - w.middle)), 0.0)
        if not w.all_ny:
            return along[None, :]
        mirrored = w.row == 0
        across = 1.0 - np.abs((rows - w.row) / (w.ny if mirrored else 0.5 * w.ny) - (not mirrored))
        return np.maximum(across, 0.0)[:, None] * along


def weight(placed, others, columns, rows):
    """Weight (rows, columns) of the values of a PlacedWindow at nodes of the fine grid (numbers of columns and rows).

    others: list of the other PlacedWindows. The weights of two windows add up to that of their union, c + d - c d with the
    weights c and d of their cores.
    """
    core = placed.core(columns, rows)
    for other in others:
        own, there = (one.nearness(columns, rows) ** SHARP for one in (placed, other))
        share = np.divide(there, own + there, out=np.full(core.shape, 0.5), where=own + there > 0)
        core = core * (1.0 - other.core(columns, rows) * share)
    return core


def inside(placed, others):
    """Mask (ny+1, nx+1) of the nodes of a window that belong to it; arguments as of :func:`weight`."""
    w = placed.window
    nodes, out = (placed.origin + np.arange(w.nx + 1), w.row + np.arange(w.ny + 1)), w.inside(placed.origin)
    for other in others:
        out &= ~((other.nearness(*nodes) > placed.nearness(*nodes)) & (other.core(*nodes) >= HALF))
    return out


def outside(placed):
    """Mask (rows, columns) of the run's nodes that belong to none of the PlacedWindows."""
    return np.logical_and.reduce([one.window.outside(one.origin) for one in placed])
