"""Memory that a run needs, or stresses under given tractions."""

import math

from tehl_taichi.disk import memory_limit
from tehl_taichi.values.digits import number_of

BASE = 80e6  # bytes of kernels and libraries that are not loaded yet, measured on 64x16 cells
NODE, ACROSS = 2000.0, 400.0  # bytes of a node, and of each of its places across the film: 512x128 and 2048x512 cells
# bytes per node of stresses: loads and operator of one depth (line contact, grid), stresses of a depth; 600x600 nodes
LINE, GRID, STRESSES = 350.0, 900.0, 48.0


def needed_bytes(scene):
    """Bytes that a run of the scene needs, within 25 %."""
    places = 0 if scene.isothermal else scene.thermal.nodes
    return BASE + (scene.grid.nx + 1) * (scene.rows + 1) * (NODE + ACROSS * places)


def check(scene, run_in=0.0):
    """Raise SceneError if a run of the scene needs more memory than is available; run_in: additional bytes for its run-in."""
    cells = f"{scene.grid.nx}" + (f" x {scene.grid.ny}" if scene.rows else "")
    of = f" with run-in ({memory_limit.words(run_in)})" if run_in else ""
    memory_limit.check(needed_bytes(scene) + run_in, f"a run on {cells} cells{of}")


def check_stresses(shape, depths):
    """Raise SceneError if stresses at this number of depths on a grid of nodes (nx,) or (nx, ny) need more memory than is
    available.
    """
    stresses = depths * STRESSES  # at the end twice: single depths and their stack
    needed = math.prod(shape) * max((GRID if len(shape) > 1 else LINE) + stresses, 2 * stresses)
    nodes = " x ".join(map(str, shape))
    memory_limit.check(needed, f"computing stresses at {nodes} nodes and {number_of(depths, 'depth')}")
