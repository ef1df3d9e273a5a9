"""The grid that a wanted error needs, from what `tehl bench accuracy` measured on the built-in scenes."""

import math

import numpy as np
from tehl_taichi.profiles.accuracy import scene_of

from tehl_taichi.scene import SceneError
from tehl_taichi.scene.scales import Scales

# {columns: largest error of film, pressure and Findley index}; `tehl bench accuracy`, 2026-11-21 (docs/benchmarks.md)
MEASURED = {
    "steady line": {64: 0.028, 128: 0.010, 256: 0.0019, 512: 0.0011, 1024: 0.00055},
    "steady circle": {64: 0.028, 128: 0.0015, 256: 0.0004},
    "passage": {64: 0.22, 128: 0.041, 256: 0.011, 512: 0.0032},
    "thermal passage": {64: 0.33, 128: 0.053, 256: 0.013},
}
MOST = 2048  # columns
MULTIPLE = 32  # of columns: the coarser grids of the solver need halves of halves


def grid_for(description, target):
    """(nx, ny) cells with which the largest error of film, pressure and Findley index is about `target` (relative).

    The resolution counts: cells per contact half-width of a steady scene, per feature width of a passage. Beyond the finest
    measured grid the error is taken to fall in proportion to the cells. Raises SceneError where that needs too fine a grid.
    """
    family = family_of(description)
    needed = _columns(MEASURED[family], target) * _cells(description) / _cells(scene_of(family, 256))
    nx = math.ceil(needed / MULTIPLE - 1e-9) * MULTIPLE
    if nx > MOST:
        finest = target * nx / MOST
        raise SceneError(f"a target error of {100 * target:.3g} % would need {nx} columns; at most {MOST} are taken, good for "
                         f"{100 * finest:.2g} % of this scene (`tehl bench accuracy` shows what grids reach)")
    return nx, max(8, round(nx * description.grid.ny / description.grid.nx / 8) * 8)


def family_of(description):
    """Which of the measured families a scene belongs to."""
    if description.transient:
        return "passage" if description.isothermal else "thermal passage"
    return "steady line" if description.contact.kind == "line" else "steady circle"


def _cells(description):
    """Columns for one cell per contact half-width, or per feature width where features pass."""
    g, a = description.grid, Scales.of(description).a
    widths = [f.width for f in description.features if f.width] if description.transient else []
    return (g.x_max - g.x_min) * a / min([a, *widths])


def _columns(errors, target):
    """Columns at which the measured error is the target: power laws between the grids, first order beyond the finest."""
    grids = sorted(errors)
    if target < errors[grids[-1]]:
        return grids[-1] * errors[grids[-1]] / target
    values = [math.log(errors[nx]) for nx in grids]
    return float(np.exp(np.interp(-math.log(target), [-v for v in values], np.log(grids))))
