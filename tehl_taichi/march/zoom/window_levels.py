"""Tables of a window: the pressure along its border is given, and its position moves."""

import dataclasses
from types import SimpleNamespace

import numpy as np

from tehl_taichi.march.zoom.window import given
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene.scales import Scales

COARSEST = 6  # least number of cells of the coarsest level along x: to invert 24 x 12 cells takes 20 times all the other work


class WindowLevels(Levels):
    """The :class:`tehl_taichi.pressure.levels.Levels` of a Window of a scene."""

    def __init__(self, scene, window):
        self.window, scales, w = window, Scales.of(scene), window
        # the pressure along the sides is given, as for a point contact; the compliance of a line contact stays
        scales = dataclasses.replace(scales, kind="point") if w.ny else scales
        full = not scene.symmetric
        height = w.ny * w.dy / (2 if full else 1) * scales.a / scales.b
        domain = SimpleNamespace(x_min=0.0, x_max=w.nx * w.dx, y_max=height)
        super().__init__(scene, w.nx, w.ny, full, scales, domain, COARSEST)
        if w.ny:
            self.Y = self.Y - self.Y[0] + w.y_min + w.row * w.dy

    def _unknown_nodes(self):
        """Mask (ny+1, nx+1) of the nodes whose pressure is unknown: all but the border."""
        ring, inside = given(self.window.factor), super()._unknown_nodes()
        inside[:, :ring], inside[:, -ring:] = 0.0, 0.0
        if self.ny:
            inside[-ring:] = 0.0
            if not self.mirrored:
                inside[:ring] = 0.0
        return inside

    def place(self, origin):
        """Move the window: its first column is this one of the fine grid."""
        self.X = self.window.columns(origin)
        self.conditions.set(centre=np.searchsorted(self.X, 0.0))
