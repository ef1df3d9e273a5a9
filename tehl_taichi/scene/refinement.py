"""Finer grids of a scene, and the work of the next one."""

import math

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import zoom_room
from tehl_taichi.values.coded_text import Option, grid_option


def doubled_grid(scene):
    """Scene on the grid with twice the cells in each direction."""
    return scene.replace(**{"grid.nx": 2 * scene.grid.nx, "grid.ny": 2 * scene.grid.ny})


def first_grid(scene, enough, most):
    """(nx, ny) of the first grid with 1, 2, 4, ... times the cells for which enough(scene) holds; None if no grid of up to
    `most` columns does.
    """
    while not enough(scene):
        if 2 * scene.grid.nx > most:
            return None
        scene = doubled_grid(scene)
    return scene.grid.nx, scene.grid.ny


def finer_grid_option(scene):
    """Text such as '--grid 512x128 (8 times the work)'; a passage also has twice the steps."""
    work = 2 ** (1 + (not scene.one_dimensional) + scene.transient)
    return _with_work(grid_option(scene, 2 * scene.grid.nx, 2 * scene.grid.ny), work)


def finer_along_option(scene):
    """Text such as '--grid 512x64 (4 times the work)': finer along x only, which suffices for an exit (docs/exit.md)."""
    return _with_work(grid_option(scene, 2 * scene.grid.nx, scene.grid.ny), 2 ** (1 + scene.transient))


def zoom_option(scene, work):
    """Text such as '--zoom 4 (6 times the work)' if the passage can have a fine window, else "". work(factor): work of the run
    with a window over that of the run alone.
    """
    if zoom_room.why_none(scene) or scene.zooms or no_window(scene, 4):
        return ""
    return _with_work(Option("--zoom 4", "a window four times as fine"), math.ceil(work(4)))


def no_window(scene, factor):
    """Reason why a scene cannot have a window of this factor; "" if it can."""
    try:
        scene.replace(**{"zoom.factor": factor})
    except SceneError as error:
        return str(error)
    return ""


def _with_work(option, work):
    return Option(f"{option} ({work} times the work)", f"{option.words} ({work} times the work)")
