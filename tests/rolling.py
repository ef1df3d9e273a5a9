"""A passage and a dry contact made of formulas, as readers of stores."""

import numpy as np

from tehl_taichi.scene.scales import Scales


class Rolling:
    """Reader of a Hertz line, shear 0.05 p along x, over which a bump of pressure and of heat passes:
    `stride` cells between two moments, the first at `begin` (in a)."""

    def __init__(self, scene, cells=8, rows=5, stride=1.0, begin=-1.5):
        self.s = Scales.of(scene)
        self.x, self.y = (np.linspace(*ends) * self.s.a for ends in ((-2, 2, 4 * cells + 1), (0, 1, rows)))
        self.centres = (begin + np.arange(0, 3.0, stride / cells)) * self.s.a
        self.time = self.centres / 8.0

    def __len__(self):
        return self.centres.size

    def feature_x(self, n):
        return self.centres[n]

    def fields(self, n, names):
        x, y = self.x[:, None] / self.s.a, self.y[None, :] / self.s.a
        hertz = np.sqrt(np.maximum(1 - x**2, 0)) + 0 * y
        bump = np.exp(-((x - self.centres[n] / self.s.a) ** 2 + y**2) / 0.04) if n else 0 * hertz
        p = self.s.p_H * hertz * (1 + bump)
        found = {"pressure": p, "traction_x_a": 0.05 * p, "traction_y_a": 0 * p, "temperature_a": 90 + 40 * hertz * (1 + bump)}
        found |= {"traction_x_b": -found["traction_x_a"], "traction_y_b": 0 * p, "temperature_b": found["temperature_a"]}
        return {name: found[name] for name in names}


class BothSides(Rolling):
    """The same on both sides of y = 0."""

    def __init__(self, scene, cells=8, rows=5):
        super().__init__(scene, cells, rows)
        self.y = np.concatenate([-self.y[:0:-1], self.y])


class Dry:
    """The dry contact of a scene, with shear and heat that the bodies share."""

    def __init__(self, scene, cells=16, shear=0.0, heat=0.0):
        s, self.shear, self.heat = Scales.of(scene), shear, heat
        self.x = np.linspace(-2, 2, 4 * cells + 1) * s.a
        self.y = np.zeros(1) if s.line else np.linspace(0, 1.5, 3 * cells // 2 + 1) * s.b
        inside = 1 - (self.x[:, None] / s.a) ** 2 - (0 if s.line else (self.y[None] / s.b) ** 2)
        self.p = s.p_H * np.sqrt(np.maximum(inside, 0.0))

    def __len__(self):
        return 1

    def fields(self, n, names):
        p = self.p
        found = {"pressure": p, "traction_x_a": self.shear * p, "traction_y_a": 0 * p, "temperature_a": 40 + self.heat * p}
        found |= {"traction_x_b": -self.shear * p, "traction_y_b": 0 * p, "temperature_b": found["temperature_a"]}
        return {name: found[name] for name in names}
