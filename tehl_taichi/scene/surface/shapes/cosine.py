"""A bump or dent with the profile of a cosine."""

import math

import numpy as np

from tehl_taichi.scene.surface.shape import Shape, share


class Cosine(Shape):
    def height(self, f, x, y):
        """(height/2)(1 + cos(2 pi r/width)) for r < width/2; elliptic with a length."""
        r = np.hypot(x, y * (f.width / f.length if f.length else 1.0))
        return np.where(r < f.width / 2, 0.5 * f.height * (1 + np.cos(2 * np.pi * r / f.width)), 0.0)

    def reach_y(self, f):
        return 0.0 if self.transverse(f) else (f.length or f.width) / 2

    def transverse(self, f):
        return math.isinf(f.length)

    def sizes(self, f):
        if self.transverse(f):
            return {"width": f.width}, {}
        return {"width": f.width}, {"length": f.length} if f.length else {"width": f.width}


COSINE = Cosine(
    name="cosine", says="bump (or dent with a negative height): one cycle of a cosine, round or elliptic",
    source="Everitt, licentiate thesis 2018, Fig 6",
    uses={"height": "negative: dent", "width": "", "length": "0: equal to width, inf: no variation along y"},
    example={"height": 1e-6, "width": 200e-6}, drawn=True,
    checked=(share("half of it at a quarter of its width", 0.5, 30e-6, 40e-6, width=200e-6),
             share("by hand, 0.5 - sqrt(1/8) at 3/8 of its length", 0.5 - 0.125**0.5, 0.0, 150e-6, width=2e-4, length=4e-4),
             share("half of it at a quarter of its width, transverse", 0.5, 50e-6, 0.1, width=200e-6, length=math.inf)))
