"""Whole passages with cells as jobs: those with rows as jobs, to rounding errors; nothing of it without being asked for."""

import os
import subprocess
import sys

import numpy as np
import pytest

from tehl_taichi.engine.language import ti

PASSAGE = """
import sys
import numpy as np
from tehl_taichi.engine import runtime
runtime.start({arch!r}, 2)
from tehl_taichi.march.passage import march
from tehl_taichi.scene import scene
description = scene("gear").replace(**{{"grid.nx": 64, "grid.ny": 16, "numerics.precision": "f64", "time.steps": 3,
                                       **{changes}}})
shots = list(march(description))
loaded = [name for name in sys.modules if ".cells" in name]
np.savez({file!r}, film=[shot.fields["film"] for shot in shots], pressure=[shot.fields["pressure"] for shot in shots],
         work=[[shot.scalars["newton"], shot.scalars["cycles"]] for shot in shots], loaded=len(loaded))
"""


def passage(file, cells, arch="cpu", **changes):
    """Film, pressure, work and number of modules of cells of a short passage in a process of its own."""
    code = PASSAGE.format(arch=arch, file=str(file), changes=changes)
    done = subprocess.run([sys.executable, "-c", code], env={**os.environ, "TEHL_CELLS": cells}, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]
    return np.load(file)


@pytest.mark.slow
@pytest.mark.parametrize("changes", ({"thermal.on": False}, {}, {"thermal.on": False, "feature.y": 2e-4}),
                         ids=("isothermal", "with temperatures", "beside the axis"))
def test_a_passage_by_cells_is_that_by_rows(tmp_path, changes):
    rows, cells = (passage(tmp_path / f"{cells}.npz", cells, **changes) for cells in "01")
    assert rows["loaded"] == 0 < cells["loaded"]
    assert (rows["work"] == cells["work"]).all() and len(rows["work"]) == 4
    for name in ("film", "pressure"):
        assert np.abs(cells[name] - rows[name]).max() < 1e-8 * np.abs(rows[name]).max()


@pytest.mark.slow
def test_a_passage_on_a_device_of_vulkan_is_that_on_the_cores(tmp_path):
    """Mesa's software device (packages mesa-vulkan-drivers and libvulkan1) will do. Newtonian oil: limits need an arcsine,
    which Taichi has there in single precision only."""
    if not ti.lang.misc.is_arch_supported(ti.vulkan):
        pytest.skip("no device of Vulkan")
    changes = {"thermal.on": False, "rheology.law": "newtonian", "numerics.tolerance": 1e-10}  # guesses are in single precision
    rows = passage(tmp_path / "rows.npz", "0", **changes)
    device = passage(tmp_path / "device.npz", "1", arch="vulkan", **changes)
    assert np.abs(rows["work"] - device["work"]).max() <= 2
    for name in ("film", "pressure"):
        assert np.abs(device[name] - rows[name]).max() < 1e-8 * np.abs(rows[name]).max()

