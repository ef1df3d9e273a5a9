"""The kernels that most tests need, written to the cache: what starts later, tests and commands, reads them."""

import tempfile
from pathlib import Path

import numpy as np

import tehl_taichi as tehl
from tehl_taichi.engine import runtime


def run():
    """The smallest run of each kind."""
    runtime.start(threads=2)
    gear = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 2})
    with tempfile.TemporaryDirectory() as folder:
        tehl.run(gear, Path(folder) / "gear.zarr")
    next(tehl.march(tehl.scene("smooth-line").replace(**{"grid.nx": 64, "thermal.on": False})))
    list(tehl.march(gear.replace(**{"thermal.on": True, "time.steps": 1})))
    tehl.fatigue(np.ones((3, 6)) * [[1e8], [-1e8], [0]])


if __name__ == "__main__":
    run()
    runtime.leave(0)
