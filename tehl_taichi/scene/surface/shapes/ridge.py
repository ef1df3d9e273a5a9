"""A transverse ridge, constant along y."""

import numpy as np

from tehl_taichi.scene.surface.shape import Shape, share

REACH = 0.7  # of its width: 10^(-10 0.7^2) is 1e-5 of the height
VALLEY = 0.040430  # of the height: depth of the valleys beside it, where tan(2 pi xi) = -10 ln(10) xi/pi, xi = 0.31504


class Ridge(Shape):
    def height(self, f, x, y):
        """height 10^(-10 xi^2) cos(2 pi xi), xi = x/width."""
        xi = x / f.width
        return f.height * 10.0 ** (-10 * xi * xi) * np.cos(2 * np.pi * xi) + 0 * y

    def reach(self, f):
        return REACH * f.width

    def transverse(self, f):
        return True

    def top(self, f):
        """Largest height: beside a furrow that of its rims."""
        return max(f.height, -VALLEY * f.height)


RIDGE = Ridge(
    name="ridge", says="transverse ridge without variation along y, with a shallow valley on both "
                       "sides", source="Venner & Lubrecht 1994",
    uses={"height": "", "width": ""}, example={"shape": "ridge", "height": 0.3e-6, "width": 150e-6}, drawn=True,
    checked=(share("by hand, 10^-0.1 cos 36 deg", 10**-0.1 * 0.8090169943749475, 50e-6, 7.0, shape="ridge", width=500e-6),))
