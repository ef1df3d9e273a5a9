"""The next finer grids of a scene, and what the first costs."""

import math

from tehl_taichi.errors import SceneError
from tehl_taichi.values.coded_text import Option, grid_option


def doubled(scene):
    """The scene on the grid with twice the cells each way."""
    return scene.replace(**{"grid.nx": 2 * scene.grid.nx, "grid.ny": 2 * scene.grid.ny})


def first(scene, enough, most):
    """(nx, ny) of the first grid with once, twice, four times ... the cells for which enough(scene) holds; None if no grid up
    to `most` columns does."""
    while not enough(scene):
        if 2 * scene.grid.nx > most:
            return None
        scene = doubled(scene)
    return scene.grid.nx, scene.grid.ny


def finer_grid_option(scene):
    """'--grid 512x128 (8 times the work)': a passage has twice the steps, too."""
    work = 2 ** (1 + (not scene.one_dimensional) + scene.transient)
    return _with_work(grid_option(2 * scene.grid.nx, 2 * scene.grid.ny), work)


def along(scene):
    """'--grid 512x64 (4 times the work)': finer along x alone, which is what an exit needs (docs/exit.md)."""
    return _with_work(grid_option(2 * scene.grid.nx, scene.grid.ny), 2 ** (1 + scene.transient))


def zoom_option(scene, work):
    """'--zoom 4 (6 times the work)', where a fine window may be added to a passage; else "". work(factor): of the run with a
    window over that of the run alone."""
    if not scene.transient or scene.zooms or no_window(scene, 4):
        return ""
    return _with_work(Option("--zoom 4", "a window four times as fine"), math.ceil(work(4)))


def no_window(scene, factor):
    """Reason why a scene cannot have a window of this factor; "" where it can."""
    try:
        scene.replace(**{"zoom.factor": factor})
    except SceneError as error:
        return str(error)
    return ""


def _with_work(option, work):
    return Option(f"{option} ({work} times the work)", f"{option.words} ({work} times the work)")
