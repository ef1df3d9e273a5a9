"""Ground surface with marks."""

import math
from types import SimpleNamespace

import numpy as np

from tehl_taichi.scene.surface.shapes.random_waves import MODES, RandomWaves
from tehl_taichi.values.registry import Checked

LONGEST = 4  # times the shortest wave: with longer ones Ra differs from patch to patch
RMS = math.sqrt(math.pi / 2)  # over Ra, of Gaussian heights
BEND = 0.25  # of the shortest wave across: how far from y = 0 the mirror is rounded off


class Ground(RandomWaves):
    def lengths(self, f):
        return tuple(map(_lengths, (f.width, f.length or f.width)))

    def rms(self, f):
        return RMS * f.height

    def waves(self, f, x, y):
        """Product waves of equal power per octave along x and y with random phases; Ra = height, also along y = 0, where a sum
        of even cosines would have twice the mean square.
        """
        rng = np.random.default_rng(f.seed)
        (k_x, k_y), (along_x, along_y) = (2 * np.pi / lengths for lengths in self.lengths(f)), self.kept(f)
        phase_x, phase_y = rng.uniform(0, 2 * np.pi, (2, k_x.size, k_y.size)) * [[[1.0]], [[float(k_y[0] > 0)]]]
        size = rng.standard_normal((k_x.size, k_y.size))
        size *= self.rms(f) / np.sqrt((size**2).sum() * (0.25 if k_y[0] > 0 else 0.5))
        even = np.hypot(y, BEND * (f.length or f.width)) if k_y[0] > 0 else y
        return sum(size[p, q] * np.cos(k_x[p] * x + phase_x[p, q]) * np.cos(k_y[q] * even + phase_y[p, q])
                   for p in along_x for q in along_y)

    def transverse(self, f):
        return math.isinf(f.length) and f.extent_y == 0

    def sizes(self, f):
        along, length = self.shortest(f)
        shown = {key: size for key, size in {"length": length, "extent_y": f.extent_y}.items() if 0 < size < math.inf}
        return {"width": along, "extent_x": f.extent_x}, shown


def _lengths(shortest):
    """Wavelengths from the longest to the shortest; inf if nothing varies."""
    return np.array([math.inf]) if math.isinf(shortest) else np.geomspace(LONGEST * shortest, shortest, MODES)


def Ra_of_many(**keys):
    """Check value: mean of |z| at 20 000 distant places of waves without end."""
    x, y = np.random.default_rng(3).uniform(-1.0, 1.0, (2, 20000))
    f = SimpleNamespace(seed=1, width=40e-6, height=0.3e-6, shortest_x=0.0, shortest_y=0.0, **keys)
    return float(np.mean(np.abs(GROUND.waves(f, x, y))))


GROUND = Ground(
    name="ground",
    says="ground surface: random waves, even in y, in a patch with a faded rim; marks along the longer of width and length",
    source="equal power per octave, as on ground surfaces; not from a measurement",
    uses={"height": "Ra", "width": "shortest wavelength along x; others up to four times it",
          "length": "shortest wavelength along y (0: equal to width, inf: no variation)", "seed": "",
          "shortest_x": "", "shortest_y": "", "extent_x": "", "extent_y": "", "taper": "", "mirror_x": ""},
    example={"shape": "ground", "height": 0.1e-6, "width": 80e-6, "length": 320e-6, "extent_x": 300e-6, "extent_y": 300e-6,
             "taper": 50e-6},
    checked=(Checked("Ra = height: Gaussian heights with the powers of their cosines", 0.3e-6,
                     lambda: Ra_of_many(length=400e-6), 0.03),
             Checked("the same without variation along y: twelve waves are less Gaussian", 0.3e-6,
                     lambda: Ra_of_many(length=math.inf), 0.05)))
