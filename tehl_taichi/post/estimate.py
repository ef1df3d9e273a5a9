"""Discretisation error of the numbers of a passage, from companion runs on coarser grids with longer steps."""

import math

from tehl_taichi.post import fatigue
from tehl_taichi.scene import SceneError
from tehl_taichi.simulation import march
from tehl_taichi.solvers.steady import estimated_error

COMPANIONS = 2  # with the run itself three grids, for the observed order; 1/8 and 1/64 of its work
PASSAGE = {"p_max_Pa": max, "h_min_m": min, "film_max_C": max, "surface_a_max_C": max, "surface_b_max_C": max}


def companions(scene):
    """The scene on grids with half and a quarter of its cells (time steps grow with the cells), coarsest first; fewer where
    the grid cannot be halved."""
    out = []
    for level in range(1, COMPANIONS + 1):
        nx, ny = scene.grid.nx / 2**level, scene.grid.ny / 2**level
        if nx != int(nx) or ny != int(ny) or 0 <= scene.time.steps < 2**level:
            break
        try:
            out.append(scene.replace(**{"grid.nx": int(nx), "grid.ny": int(ny), "time.steps": scene.time.steps // 2**level}))
        except SceneError:
            break
    return out[::-1]


def values(scene):
    """{name: number} of one run: extremes over the passage, and Fi_max where fatigue is wanted."""
    shots = list(march(scene))
    out = {name: pick(shot.scalars[name] for shot in shots[1:]) for name, pick in PASSAGE.items()
           if name in shots[0].scalars}
    if scene.fatigue_wanted:
        out["Fi_max"] = fatigue.run(scene, shots).summary["Fi_max"]
    return out


def errors(scene, finest, progress=None):
    """{name: estimated error} of `finest` ({name: number}) by Richardson with the observed order; nan where no coarser run
    was possible. progress: called with a line of text before each companion run. Raises NotConverged."""
    series = []
    for companion in companions(scene):
        if progress:
            progress(f"companion run for the error: {companion.grid.nx} x {companion.grid.ny} cells")
        series.append(values(companion))
    return {name: estimated_error([*(run[name] for run in series), finest[name]]) if series else math.nan for name in finest}
