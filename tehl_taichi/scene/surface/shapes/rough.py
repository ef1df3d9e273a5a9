"""Random roughness."""

from types import SimpleNamespace

import numpy as np

from tehl_taichi.scene.surface.shapes.random_waves import MODES, Random, RandomWaves
from tehl_taichi.values.registry import Checked


class Rough(RandomWaves):
    def lengths(self, f):
        """Wavelengths up to the length of the patch."""
        return (np.geomspace(max(f.extent_x, 2 * f.width), f.width, MODES),) * 2

    def waves(self, f, x, y):
        """Sum of cosines of equal power per octave with random phases in x, even in y; rms = height, on y = 0, where all have
        a crest, sqrt(2) times that.
        """
        rng = np.random.default_rng(f.seed)
        k, (along_x, along_y) = 2 * np.pi / self.lengths(f)[0], self.kept(f)
        phase, size = rng.uniform(0, 2 * np.pi, (MODES, MODES)), rng.standard_normal((MODES, MODES))
        size *= 2 * f.height / np.sqrt((size**2).sum())
        return sum(sum(size[p, q] * np.cos(k[p] * x + phase[p, q]) for p in along_x) * np.cos(k[q] * y) for q in along_y)

    def sizes(self, f):
        along, across = self.shortest(f)
        return ({"width": along, "extent_x": f.extent_x},
                {"width": across} | ({"extent_y": f.extent_y} if f.extent_y > 0 else {}))


def rms_of_many():
    """Check value: rms at 20 000 distant places of waves without end."""
    places = np.random.default_rng(3).uniform(-1.0, 1.0, (2, 20000))
    f = SimpleNamespace(seed=1, extent_x=500e-6, width=40e-6, height=0.2e-6, shortest_x=0.0, shortest_y=0.0)
    return float(np.sqrt(np.mean(ROUGH.waves(f, *places) ** 2)))


ROUGH = Rough(
    name="rough", says="random roughness, even in y, in a patch with a faded rim",
    source="equal power per octave, as on ground surfaces; not from a measurement", keys=Random,
    uses={"height": "rms; on y = 0, about which it is even, 1.4 times as much (ground has one Ra everywhere)",
          "width": "shortest wavelength; others up to the patch size",
          "extent_x": "", "extent_y": "", "taper": "", "mirror_x": ""},
    example={"shape": "rough", "height": 0.1e-6, "width": 80e-6, "extent_x": 300e-6, "extent_y": 300e-6, "taper": 50e-6},
    checked=(Checked("rms = height: the square of sums of cosines has their powers for its mean", 0.2e-6, rms_of_many, 0.02),))
