"""Memory that a run needs."""

from tehl_taichi.disk import memory_limit

BASE = 80e6  # bytes of kernels and libraries that are not loaded yet, measured on 64x16 cells
NODE, ACROSS = 2000.0, 400.0  # bytes of a node, and of each of its places across the film: 512x128 and 2048x512 cells


def needed_bytes(scene):
    """Bytes that a run of the scene needs, within 25 %."""
    places = 0 if scene.isothermal else scene.thermal.nodes
    return BASE + (scene.grid.nx + 1) * (scene.rows + 1) * (NODE + ACROSS * places)


def check(scene, run_in=0.0):
    """Raise SceneError if a run of the scene needs more memory than is available; run_in: additional bytes for its run-in."""
    cells = f"{scene.grid.nx}" + (f" x {scene.grid.ny}" if scene.rows else "")
    of = f" with run-in ({memory_limit.words(run_in)})" if run_in else ""
    memory_limit.check(needed_bytes(scene) + run_in, f"a run on {cells} cells{of}")
