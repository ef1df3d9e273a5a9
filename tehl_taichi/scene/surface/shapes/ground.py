"""Ground surface with marks."""

import math
from types import SimpleNamespace

import numpy as np

from tehl_taichi.scene.surface.shape import FINE, needs_patch
from tehl_taichi.scene.surface.shapes.patch import Patch
from tehl_taichi.values.registry import Checked

MODES = 12  # per direction
LONGEST = 4  # times the shortest wave: with longer ones Ra differs from patch to patch
RMS = math.sqrt(math.pi / 2)  # over Ra, of Gaussian heights
BEND = 0.25  # of the shortest wave across: how far from y = 0 the mirror is rounded off


class Ground(Patch):
    rough = True

    def finest(self, f):
        return f.width / FINE, (f.length or f.width) / FINE

    def height(self, f, x, y):
        return self.waves(f, x, y) * self.window(f, x, y)

    def waves(self, f, x, y):
        """Product waves of equal power per octave along x and along y with random phases; Ra = height, also on y = 0, where a
        sum of even cosines would have twice the mean square."""
        rng = np.random.default_rng(f.seed)
        k_x, k_y = map(_numbers, (f.width, f.length or f.width))
        phase_x, phase_y = rng.uniform(0, 2 * np.pi, (2, k_x.size, k_y.size)) * [[[1.0]], [[float(k_y[0] > 0)]]]
        size = rng.standard_normal((k_x.size, k_y.size))
        size *= RMS * f.height / np.sqrt((size**2).sum() * (0.25 if k_y[0] > 0 else 0.5))
        even = np.hypot(y, BEND * f.length) if k_y[0] > 0 else y
        return sum(size[p, q] * np.cos(k_x[p] * x + phase_x[p, q]) * np.cos(k_y[q] * even + phase_y[p, q])
                   for p in range(k_x.size) for q in range(k_y.size))

    def transverse(self, f):
        return math.isinf(f.length) and f.extent_y == 0

    def check(self, f):
        needs_patch(f)
        super().check(f)

    def sizes(self, f):
        across = {"length": f.length or f.width, "extent_y": f.extent_y}
        shown = {key: size for key, size in across.items() if 0 < size < math.inf}
        return {"width": f.width, "extent_x": f.extent_x}, shown


def _numbers(shortest):
    """Wave numbers (1/m) from the longest wave to the shortest; one of 0 where nothing varies."""
    if math.isinf(shortest):
        return np.zeros(1)
    return 2 * np.pi / np.geomspace(LONGEST * shortest, shortest, MODES)


def Ra_of_many(**keys):
    """Mean of |z| at 20 000 places far apart of waves that go on without end."""
    x, y = np.random.default_rng(3).uniform(-1.0, 1.0, (2, 20000))
    f = SimpleNamespace(seed=1, width=40e-6, height=0.3e-6, **keys)
    return float(np.mean(np.abs(GROUND.waves(f, x, y))))


GROUND = Ground(
    name="ground",
    says="ground surface: random waves, even in y, in a patch with a faded rim; marks along the longer of width and length",
    source="equal power per octave, as on ground surfaces; not from a measurement",
    uses={"height": "Ra", "width": "shortest wavelength along x; others up to four times it",
          "length": "shortest wavelength along y (0: equal to width, inf: no variation)", "seed": "", "extent_x": "",
          "extent_y": "", "taper": ""},
    example={"shape": "ground", "height": 0.1e-6, "width": 80e-6, "length": 320e-6, "extent_x": 300e-6, "extent_y": 300e-6,
             "taper": 50e-6},
    checked=(Checked("Ra = height: Gaussian heights with the powers of their cosines", 0.3e-6,
                     lambda: Ra_of_many(length=400e-6), 0.03),
             Checked("the same without variation along y: twelve waves are less Gaussian", 0.3e-6,
                     lambda: Ra_of_many(length=math.inf), 0.05)))
