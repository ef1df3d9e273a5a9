"""Random roughness."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from tehl_taichi.scene.surface.shape import FINE, needs_patch
from tehl_taichi.scene.surface.shapes.patch import Patch
from tehl_taichi.values.quantity import count
from tehl_taichi.values.registry import Checked

MODES = 12  # per direction


@dataclass(frozen=True)
class Random:
    seed: int = count(1, "rough: seed of the random numbers", 0, 2**31)


class Rough(Patch):
    rough = True

    def finest(self, f):
        return f.width / FINE, f.width / FINE

    def height(self, f, x, y):
        return self.waves(f, x, y) * self.window(f, x, y)

    def waves(self, f, x, y):
        """Sum of cosines of equal power per octave with random phases in x, even in y; rms = height."""
        rng = np.random.default_rng(f.seed)
        longest = max(f.extent_x, 2 * f.width)
        k = 2 * np.pi / np.geomspace(longest, f.width, MODES)
        phase, size = rng.uniform(0, 2 * np.pi, (MODES, MODES)), rng.standard_normal((MODES, MODES))
        size *= 2 * f.height / np.sqrt((size**2).sum())
        along = [sum(size[p, q] * np.cos(k[p] * x + phase[p, q]) for p in range(MODES)) for q in range(MODES)]
        return sum(along[q] * np.cos(k[q] * y) for q in range(MODES))

    def check(self, f):
        needs_patch(f)
        super().check(f)

    def sizes(self, f):
        across = {"width": f.width} | ({"extent_y": f.extent_y} if f.extent_y > 0 else {})
        return {"width": f.width, "extent_x": f.extent_x}, across


def rms_of_many():
    """rms at 20 000 places far apart of waves that go on without end."""
    places = np.random.default_rng(3).uniform(-1.0, 1.0, (2, 20000))
    f = SimpleNamespace(seed=1, extent_x=500e-6, width=40e-6, height=0.2e-6)
    return float(np.sqrt(np.mean(ROUGH.waves(f, *places) ** 2)))


ROUGH = Rough(
    name="rough", says="random roughness, even in y, in a patch with a faded rim",
    source="equal power per octave, as on ground surfaces; not from a measurement", keys=Random,
    uses={"height": "rms", "width": "shortest wavelength; others up to the patch "
                                    "size", "extent_x": "", "extent_y": "", "taper": ""},
    example={"shape": "rough", "height": 0.1e-6, "width": 80e-6, "extent_x": 300e-6, "extent_y": 300e-6, "taper": 50e-6},
    checked=(Checked("rms = height: the square of sums of cosines has their powers for its mean", 0.2e-6, rms_of_many, 0.02),))
