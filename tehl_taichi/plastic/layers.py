"""Layers of a body: the upper ones may yield, the lower ones are elastic."""

from dataclasses import dataclass

import numpy as np

# Parts of the shortest length: steel under an asperity yields first at a tenth of its width
THINNEST = 0.025
EVEN = 0.2        # as far down layers are equally thick: eight of them at least
GROWTH = 1.3      # of thicknesses below that
REACH = 1.0       # a: no steel flows below it, where a smooth contact is worst
DEEPEST, FASTER = 25.0, 1.5  # depth (a) of the fixed bottom, and growth of the elastic layers towards it


@dataclass(frozen=True)
class Layers:
    """Thicknesses (m) of all layers from the surface down; the first `count` may yield."""

    thickness: np.ndarray
    count: int

    @property
    def depths(self):
        """Depths (m) of the middles of the layers that may yield."""
        return (np.cumsum(self.thickness) - self.thickness / 2)[: self.count]


def layers(a, spacing, shortest):
    """Layers for a contact of half-width a (m) on cells of `spacing` (m); shortest: of a and the widths of the features (m)."""
    first = min(spacing, THINNEST * shortest)
    found = [first] * round(EVEN * shortest / first)
    while sum(found) < REACH * a:
        found.append(found[-1] * GROWTH)
    count = len(found)
    while sum(found) < DEEPEST * a:
        found.append(found[-1] * FASTER)
    return Layers(np.array(found), count)
