"""Residual stress by plastic flow in a body, interpolated between its known points."""

from dataclasses import dataclass, replace

import numpy as np

from tehl_taichi.fatigue.stress.averaging import averaged
from tehl_taichi.fatigue.stress.unit_loads import ACROSS

FREE = [2, 4, 5]  # zz, xz, yz: components that are zero at the surface
ENDS = 1.5        # the stress falls to zero at this multiple of the deepest depth


@dataclass(frozen=True)
class ResidualField:
    """Residual stress (layers, 6, nx, rows) Pa at x (nx,), y (rows,), depths (layers,) m in the frame of the surface; zero
    beyond these points."""

    x: np.ndarray
    y: np.ndarray
    depths: np.ndarray
    stress: np.ndarray

    def at(self, x, y, depths):
        """Stresses (x, y, depths, 6) Pa at these positions (m)."""
        found = np.tensordot(_weights(self.x, x), self.stress, (1, 2))  # x, layers, 6, y
        found = np.tensordot(found, _weights(self.y, y), (3, 1))  # x, layers, 6, y
        found = np.moveaxis(np.tensordot(found, self._in_depth(depths), (1, 1)), 1, -1)  # x, y, depths, 6
        found[..., FREE] *= np.minimum(np.asarray(depths, float) / self.depths[0], 1.0)[:, None]
        return found

    def _in_depth(self, depths):
        """Weights (depths, layers): linear between the middles of layers and on to the surface, zero at ENDS."""
        deep = np.asarray(depths, float)
        out = _weights(np.append(self.depths, ENDS * self.depths[-1]), deep)[:, :-1]
        above = deep < self.depths[0]
        part = (deep[above] - self.depths[0]) / (self.depths[1] - self.depths[0])
        out[above] = 0.0
        out[above, 0], out[above, 1] = 1 - part, part
        return out

    def averaged(self, along, across, mirrored):
        """Field averaged over a square by weights along x and y (:mod:`tehl_taichi.fatigue.stress.averaging`)."""
        stress = averaged(self.stress, along, 2)
        parts = [averaged(stress[:, n], across, 2, mirrored, ACROSS[n] < 0) for n in range(6)]
        return replace(self, stress=np.stack(parts, axis=1))


def _weights(nodes, to):
    """Linear interpolation weights (to, nodes), 0 beyond the ends; a single node is constant."""
    to = np.atleast_1d(np.asarray(to, float))
    if len(nodes) == 1:
        return np.ones((to.size, 1))
    place = np.interp(to, nodes, np.arange(len(nodes)), left=-1.0, right=len(nodes))
    return np.maximum(1 - np.abs(place[:, None] - np.arange(len(nodes))), 0.0)
