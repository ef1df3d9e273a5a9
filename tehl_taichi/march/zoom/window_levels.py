"""Tables of a window: its pressure is given along its border, its places move."""

import dataclasses
from types import SimpleNamespace

import numpy as np

from tehl_taichi.march.zoom.window import given
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene.scales import Scales

# cells along x of its coarsest level, at least; the inverse of 24 x 12 cells takes 20 times as long as all the rest
COARSEST = 6


class WindowLevels(Levels):
    """:class:`tehl_taichi.pressure.levels.Levels` of a Window of a scene."""

    def __init__(self, scene, window):
        self.window, scales, w = window, Scales.of(scene), window
        # sides are given as those of a point contact are; its compliance stays
        scales = dataclasses.replace(scales, kind="point") if w.ny else scales
        full = not scene.symmetric
        height = w.ny * w.dy / (2 if full else 1) * scales.a / scales.b
        domain = SimpleNamespace(x_min=0.0, x_max=w.nx * w.dx, y_max=height)
        super().__init__(scene, scales, w.nx, w.ny, full, domain, COARSEST)
        if w.ny:
            self.Y = self.Y - self.Y[0] + w.y_min + w.row * w.dy

    def _unknown_nodes(self):
        ring, inside = given(self.window.factor), super()._unknown_nodes()
        inside[:, :ring], inside[:, -ring:] = 0.0, 0.0
        if self.ny:
            inside[-ring:] = 0.0
            if not self.mirrored:
                inside[:ring] = 0.0
        return inside

    def place(self, origin):
        """Its columns begin with this one of the fine grid."""
        self.X = self.window.columns(origin)
        self.conditions.set(centre=np.searchsorted(self.X, 0.0))
