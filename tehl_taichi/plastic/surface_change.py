"""Change of a surface by plastic flow, as a passage uses it."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.values.interpolation import lagrange

NODES = range(-1, 3)  # of the interpolation, from the node before a place


@dataclass(frozen=True)
class SurfaceChange:
    """Sinking of surface "a" or "b": (nx, rows) m, positive into the body, at x (nx,), y (rows,) m of its frame; zero beyond.

    mirrored: rows begin at y = 0, which is a plane of symmetry.
    """

    surface: str
    x: np.ndarray
    y: np.ndarray
    sinking: np.ndarray
    mirrored: bool

    def at(self, x, y):
        """Sinking (m) at (y, x) for positions x (n,) and y (m,) of its frame."""
        along, across = _weights(self.x, x), _weights(self.y, y, self.mirrored)
        return across @ self.sinking.T @ along.T


def _weights(nodes, to, mirrored=False):
    """Cubic interpolation weights (to, nodes), 0 beyond the ends; a single node is constant. mirrored: the first node is a
    symmetry axis.
    """
    to, size = np.asarray(to, float), len(nodes)
    if size == 1:
        return np.ones((to.size, 1))
    place = (to - nodes[0]) / (nodes[1] - nodes[0])
    whole = np.floor(place + 1e-6).astype(int)
    part = np.where(np.abs(place - whole) < 1e-6, 0.0, place - whole)
    out = np.zeros((to.size, size))
    for weight, n in zip(lagrange(NODES, part), NODES):
        node = np.abs(whole + n) if mirrored else whole + n
        inside = np.flatnonzero((node >= 0) & (node < size))
        out[inside, node[inside]] += weight[inside]
    return out
