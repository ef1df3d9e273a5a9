"""Grid that reaches a target error, from the errors that `tehl bench accuracy` measured on the built-in scenes."""

import functools
import json
import math
from pathlib import Path

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import domain, refinement
from tehl_taichi.scene.resolution import shortest_length
from tehl_taichi.scene.scales import Scales
from tehl_taichi.scene.surface.maps import map_warnings

# Written by `tehl bench accuracy --keep`: {"machine", "families": {name: {"columns_per_width": columns for one cell per
# half-width or width of the feature, "errors": {columns: largest relative error of film, pressure and Findley index}}}}
FILE = Path(__file__).with_name("grid_errors.json")
MOST = 2048  # columns
MULTIPLE = 32  # of columns: the coarser grids of the solver need halves of halves


def reaching(description, target):
    """Scene on a grid and a domain with which the largest error of film, pressure and Findley index is about `target`.

    Up to half of it is the error of the domain, whose ends may then be nearer. Raises SceneError.
    """
    wide = domain.within(description, target / 2)
    nx, ny = grid_for(wide, target)
    return wide.replace(**{"grid.nx": nx, "grid.ny": ny})


def grid_for(description, target):
    """Cells (nx, ny) with which the largest relative error of film, pressure and Findley index is about `target`.

    The measure is the resolution: cells per contact half-width in a steady scene, per feature width in a passage. Measured maps
    must also be resolved (:mod:`tehl_taichi.scene.surface.maps.map_warnings`). Beyond the finest measured grid the error is
    assumed to be inversely proportional to the number of cells. Raises SceneError if that needs too fine a grid.
    """
    measured = families()[family_of(description)]
    errors = {int(nx): error for nx, error in measured["errors"].items()}
    needed = _columns(errors, target) * columns_per_width(description) / measured["columns_per_width"]
    nx = math.ceil(needed / MULTIPLE - 1e-9) * MULTIPLE
    if nx > MOST:
        finest = target * nx / MOST
        raise SceneError(f"a target error of {100 * target:.3g} % would need {nx} columns; allowed: at most {MOST}, which give "
                         f"{100 * finest:.2g} % for this scene (see `tehl bench accuracy`)")
    return _seeing_maps(description, nx, max(8, round(nx * description.grid.ny / description.grid.nx / 8) * 8))


def _seeing_maps(description, nx, ny):
    """This grid, or the first with 2, 4, ... times its columns and rows that resolves the measured maps; if no grid of up to
    MOST columns does, this one, with the scene's warnings.
    """
    start = description.replace(**{"grid.nx": nx, "grid.ny": ny})
    return refinement.first_grid(start, map_warnings.resolves_maps, MOST) or (nx, ny)


@functools.cache
def families():
    """Measured errors by family of scenes."""
    return json.loads(FILE.read_text())["families"]


def family_of(description):
    """Family of the measured scenes to which a scene belongs."""
    if description.transient:
        return "passage" if description.isothermal else "thermal passage"
    return "steady line" if description.contact.kind == "line" else "steady circle"


def columns_per_width(description):
    """Number of columns for one cell per contact half-width, or per feature width if features pass."""
    g = description.grid
    return (g.x_max - g.x_min) * Scales.of(description).a / shortest_length(description)


def _columns(errors, target):
    """Columns at which the measured error is `target`: power laws between the measured grids, first order beyond the finest."""
    grids = sorted(errors)
    if target < errors[grids[-1]]:
        return grids[-1] * errors[grids[-1]] / target
    values = [math.log(errors[nx]) for nx in grids]
    return float(np.exp(np.interp(-math.log(target), [-v for v in values], np.log(grids))))
