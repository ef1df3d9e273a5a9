"""A dent with a raised rim, as particles leave in raceways."""

import math
from dataclasses import dataclass

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.shape import Shape, share
from tehl_taichi.values.quantity import quantity

RIM_SHARE = 0.25  # width of the rim over that of the dent, by default


@dataclass(frozen=True)
class Rim:
    rim: float = quantity(0.0, "m", "dent: height of the rim around it; needed", 0.0, 1e-4, usual=1e-6)
    rim_width: float = quantity(0.0, "m", f"dent: width of the rim; 0: {RIM_SHARE:g} width", 0.0, 0.01, usual=5e-5)


class Dent(Shape):
    def height(self, f, x, y):
        """Cosine dent within width/2, surrounded by a ring whose section is one period of a cosine; slopes are continuous."""
        r, edge, wide = np.hypot(x, y), f.width / 2, self.rim_width(f)
        inside = 0.5 * f.height * (1 + np.cos(2 * np.pi * r / f.width))
        ring = 0.5 * f.rim * (1 - np.cos(2 * np.pi * (r - edge) / wide))
        return np.where(r < edge, inside, np.where(r < edge + wide, ring, 0.0))

    def rim_width(self, f):
        """Width (m) of the rim."""
        return f.rim_width or RIM_SHARE * f.width

    def reach(self, f):
        return f.width / 2 + self.rim_width(f)

    def reach_y(self, f):
        return self.reach(f)

    def top(self, f):
        return f.rim

    def sizes(self, f):
        sizes = {"width": f.width, "rim_width": self.rim_width(f)}
        return sizes, dict(sizes)

    def check(self, f):
        if f.height >= 0:
            raise SceneError(f"feature.height = {f.height:g} m: a dent has a negative height; allowed: less than 0 m")
        if f.rim <= 0:
            raise SceneError(f"feature.rim = {f.rim:g} m: a dent needs the height of its rim, more than 0 m (without a rim: "
                             "feature.shape = 'cosine')")


DENT = Dent(
    name="dent", says="round dent with a raised rim",
    source="dents of particles have shoulders (Ville & Nelias, Tribology Transactions 42, 1999); cosines chosen here",
    uses={"height": "negative: depth of the dent", "width": "of the dent inside its rim"}, keys=Rim,
    example={"shape": "dent", "height": -1e-6, "width": 200e-6, "rim": 0.2e-6},
    checked=(share("the middle of the rim is its top", 0.2, 75e-6, 100e-6, shape="dent", height=-1e-6, width=200e-6, rim=2e-7),
             share("half of the rim at a quarter of its width", 0.1, 112.5e-6, 0.0, shape="dent", height=-1e-6, width=200e-6,
                   rim=2e-7),
             share("by hand, half of the depth at a quarter of the width", -0.5, 0.0, 50e-6, shape="dent", height=-1e-6,
                   width=200e-6, rim=2e-7, rim_width=math.pi * 1e-5)))
