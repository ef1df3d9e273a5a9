"""Base of the shapes that fill a rectangle and fade out at its rim."""

import math

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.shape import Shape


class Patch(Shape):
    def patch(self, f):
        """Size (along x, along y) of the rectangle."""
        return f.extent_x, f.extent_y or math.inf

    def check(self, f):
        """Refuse a taper that leaves no unchanged height: at most half of the shorter side."""
        short = min(self.patch(f))
        if f.taper > short / 2 * (1 + 1e-9):
            key = "extent_x" if short == self.patch(f)[0] else "extent_y"
            raise SceneError(f"feature.taper = {f.taper:g} m fades out more than half of the patch, {short:.4g} m "
                             f"(feature.{key}); allowed: at most {short / 2:.4g} m")

    def reach(self, f):
        return self.patch(f)[0] / 2

    def reach_y(self, f):
        return 0.0 if self.transverse(f) else self.patch(f)[1] / 2

    def window(self, f, x, y):
        """1 inside the patch, fading to 0 at its rim (half a cosine over `taper`)."""
        length, width = self.patch(f)
        return _fade(np.abs(x), length / 2, f.taper) * _fade(np.abs(y), width / 2, f.taper)


def _fade(distance, rim, taper):
    if taper <= 0:
        return (distance <= rim).astype(float)
    return 0.5 * (1 - np.cos(np.pi * np.clip((rim - distance) / taper, 0.0, 1.0)))
