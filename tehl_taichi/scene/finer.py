"""The next finer grid of a scene, and what it costs."""


def doubled(scene):
    """The scene on the grid with twice the cells each way."""
    return scene.replace(**{"grid.nx": 2 * scene.grid.nx, "grid.ny": 2 * scene.grid.ny})


def told(scene):
    """'--grid 512x128 (8 times the work)': a passage has twice the steps, too."""
    work = 2 ** (1 + (not scene.one_dimensional) + scene.transient)
    return f"--grid {2 * scene.grid.nx}x{2 * scene.grid.ny} ({work} times the work)"
