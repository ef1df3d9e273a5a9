"""Points of a fatigue search: where they lie, and which of them are searched in full."""

import enum
from typing import NamedTuple

import numpy as np


class Sought(enum.Enum):
    """Points that are searched in full; of the others only those that may be the worst.

    ALL: all points. COUNTED: those in statistics of the index (with the worst, these have error bars). WORST: none.
    """

    ALL = enum.auto()
    COUNTED = enum.auto()
    WORST = enum.auto()

    @property
    def brief(self):
        """Whether some points are not searched in full."""
        return self is not Sought.ALL


class Box(NamedTuple):
    """Points to search: (from, to) in m of x', y and depth.

    chosen_y: positions y (m) of the rows below which the depth is searched; None: rows of the feature and of the worst points.
    """

    x: tuple
    y: tuple
    depth: tuple = (0.0, np.inf)
    chosen_y: tuple | None = None
