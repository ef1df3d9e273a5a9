"""The change of a surface by plastic flow, as a passage sees it."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.values.interpolation import lagrange

NODES = range(-1, 3)  # of the interpolation along x, from the node before a place


@dataclass(frozen=True)
class SurfaceChange:
    """surface: "a" or "b"; x (nx,), y (rows,) m in its frame; sinking (nx, rows) m, into the body. Nothing beyond.

    mirrored: rows begin with y = 0 and have their image on the other side."""

    surface: str
    x: np.ndarray
    y: np.ndarray
    sinking: np.ndarray
    mirrored: bool

    def at(self, x, y):
        """Sinking (m) at (y, x) of places x (n,) and y (m,) in its frame."""
        return self._across(np.abs(y) if self.mirrored else y) @ self._along(x).T

    def _along(self, x):
        """(x, rows): cubic between columns, exact on them."""
        size, edge = len(self.x), len(NODES)
        padded = np.pad(self.sinking, ((edge, edge), (0, 0)))
        place = (np.asarray(x) - self.x[0]) / (self.x[1] - self.x[0])
        whole = np.floor(place + 1e-6)
        inside = (whole >= -1) & (whole < size)
        node = np.where(inside, whole, -2).astype(int) + edge
        weights = lagrange(NODES, np.where(np.abs(place - whole) < 1e-6, 0.0, place - whole))
        return sum((w * inside)[:, None] * padded[node + n] for w, n in zip(weights, NODES))

    def _across(self, y):
        """(y, rows): linear between rows; one row holds everywhere."""
        if len(self.y) == 1:
            return np.ones((len(y), 1))
        place = np.interp(y, self.y, np.arange(len(self.y)), left=-1.0, right=len(self.y))
        return np.maximum(1 - np.abs(place[:, None] - np.arange(len(self.y))), 0.0)
