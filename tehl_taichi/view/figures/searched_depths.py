"""Depths of a fatigue search, as figures and reports find them among its maps."""

import numpy as np


def under_row(of):
    """Depths (m) of what lies under a row: of their own where others were listed; of(name): one of the maps, or None."""
    own = of("under_row_depth")
    return of("fatigue_depth") if own is None else own


def beside_worst(depths, worst):
    """Which of the depths whose points were all searched lies next to the worst (m); the surface, their first, apart."""
    return 1 + int(np.argmin(np.abs(depths[1:] - worst)))
