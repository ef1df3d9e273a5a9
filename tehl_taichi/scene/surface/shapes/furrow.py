"""A transverse furrow."""

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.shape import share
from tehl_taichi.scene.surface.shapes.ridge import Ridge


class Furrow(Ridge):
    def check(self, f):
        if f.height > 0:
            raise SceneError(f"feature.height = {f.height:g} m must be negative for a furrow")


FURROW = Furrow(
    name="furrow", says="an inverted ridge", source="Venner & Lubrecht 1994", uses={"height": "negative", "width": ""},
    example={"shape": "furrow", "height": -0.5e-6, "width": 200e-6},
    checked=(share("by hand, 10^-2.5 of it: a rim", 10**-2.5, 100e-6, 1.0, shape="furrow", height=-1e-6, width=200e-6),))
