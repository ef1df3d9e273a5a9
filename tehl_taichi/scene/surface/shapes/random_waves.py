"""Base of shapes that are sums of many waves with random phases; a coarse grid resolves only the long ones."""

import math
from dataclasses import dataclass, replace

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.surface.shape import FINE, needs_patch
from tehl_taichi.scene.surface.shapes.patch import Patch
from tehl_taichi.values.quantity import count, quantity

MODES = 12  # per direction
LONGEST = 0.03  # m
HIGHEST = 4.0  # times the rms is the largest height, about (waves from 40 um on: 2.1 to 3.3 on 0.3 mm, 2.6 to 4.1 on 1.2 mm)
SLACK = 1 + 1e-9  # a wave of exactly the shortest length stays


@dataclass(frozen=True)
class Random:
    """Keys of random waves only."""

    seed: int = count(1, "rough, ground: seed of the random numbers", 0, 2**31)
    shortest_x: float = quantity(0.0, "m", "rough, ground: waves along x shorter than this are left out; the others keep their "
                                           "heights and phases", 0.0, LONGEST, usual=1e-4)
    shortest_y: float = quantity(0.0, "m", "rough, ground: as shortest_x, along y", 0.0, LONGEST, usual=1e-4)


class RandomWaves(Patch):
    rough = True

    def lengths(self, f):
        """Wavelengths along x and along y, the longest first; inf without variation."""
        raise NotImplementedError(f"{self.name} has no waves")

    def waves(self, f, x, y):
        """Heights before fading at the rim of the patch."""
        raise NotImplementedError(f"{self.name} has no waves")

    def height(self, f, x, y):
        return self.waves(f, -x if f.mirror_x else x, y) * self.window(f, x, y)

    def rms(self, f):
        """Root mean square of its heights."""
        return f.height

    def top(self, f):
        """Largest height, as an estimate."""
        return HIGHEST * abs(self.rms(f))

    def kept(self, f):
        """Indices (along x, along y) of the waves that are kept."""
        return [np.flatnonzero(lengths * SLACK >= least)
                for lengths, least in zip(self.lengths(f), (f.shortest_x, f.shortest_y))]

    def shortest(self, f):
        """Shortest kept waves along x and along y."""
        return [float(lengths[kept].min()) for lengths, kept in zip(self.lengths(f), self.kept(f))]

    def finest(self, f):
        return tuple(length / FINE for length in self.shortest(f))

    def coarser(self, f, x, y):
        lengths = self.lengths(f)
        if lengths[0].max() * SLACK < x or lengths[1].max() * SLACK < y:
            return None
        return replace(f, shortest_x=max(f.shortest_x, x), shortest_y=max(f.shortest_y, y))

    def idle(self, f):
        return {f"shortest_{name}": f"its waves do not vary along {name}" for name, lengths in zip("xy", self.lengths(f))
                if math.isinf(lengths.max())}

    def check(self, f):
        """Refuse a patch without a length, and one without waves."""
        needs_patch(f)
        for name, lengths in zip("xy", self.lengths(f)):
            if getattr(f, f"shortest_{name}") > lengths.max() * SLACK:
                raise SceneError(f"feature.shortest_{name} = {getattr(f, f'shortest_{name}'):g} m leaves no wave along {name}; "
                                 f"allowed: at most {lengths.max():.4g} m, its longest")
        super().check(f)
