"""The next finer grids of a scene, and what they cost."""


def doubled(scene, times=1):
    """(nx, ny) of the grid with twice the cells each way, so many times over."""
    return scene.grid.nx << times, scene.grid.ny << times


def on_doubled(scene, times=1):
    """The scene on that grid."""
    nx, ny = doubled(scene, times)
    return scene.replace(**{"grid.nx": nx, "grid.ny": ny})


def told(scene, times=1):
    """'--grid 512x128 (8 times the work)': a passage has twice the steps, too."""
    nx, ny = doubled(scene, times)
    work = 2 ** (times * (1 + (not scene.one_dimensional) + scene.transient))
    return f"--grid {nx}x{ny} ({work} times the work)"
