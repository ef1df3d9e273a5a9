"""Waves along x, or along x and y."""

import math

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.shape import FINE, needs_patch, share
from tehl_taichi.scene.surface.shapes.patch import Patch


class Waviness(Patch):
    rough = True

    def finest(self, f):
        return f.width / FINE, f.length / FINE or math.inf

    def height(self, f, x, y):
        """height cos(2 pi x/width) cos(2 pi y/length) within its patch."""
        across = np.cos(2 * np.pi * y / f.length) if f.length else 1.0
        return f.height * np.cos(2 * np.pi * x / f.width) * across * self.window(f, x, y)

    def top(self, f):
        """Largest height: of waves with a negative one, that of their first crest, as far as it lies in the patch."""
        if f.height >= 0:
            return f.height
        x, y = np.linspace(0.0, f.width, 129)[:, None], np.linspace(0.0, f.length, 65)
        return max(0.0, float(self.height(f, x, y).max()))

    def transverse(self, f):
        return f.length == 0 and f.extent_y == 0

    def check(self, f):
        needs_patch(f)
        super().check(f)
        if math.isinf(f.length):
            raise SceneError("feature.length = inf m; waves without variation along y have length = 0")

    def sizes(self, f):
        across = {"extent_y": f.extent_y, "length": f.length}
        return {"width": f.width, "extent_x": f.extent_x}, {key: size for key, size in across.items() if size > 0}


WAVINESS = Waviness(
    name="waviness", says="waves along x, or along x and y, in a patch with a faded rim",
    source="Venner & Lubrecht 1994",
    uses={"height": "amplitude", "width": "wavelength", "length": "wavelength along y, 0: transverse", "extent_x": "",
          "extent_y": "", "taper": ""},
    example={"shape": "waviness", "height": 0.1e-6, "width": 100e-6, "extent_x": 300e-6, "taper": 50e-6},
    checked=(share("half of it a sixth of the wave from a crest, in both directions", 0.25, 10e-6, 15e-6, shape="waviness",
                   width=60e-6, length=90e-6, extent_x=600e-6, extent_y=600e-6),
             share("half of a crest in the middle of the taper", 0.5, 240e-6, 0.0, shape="waviness", width=60e-6,
                   extent_x=600e-6, taper=120e-6)))
