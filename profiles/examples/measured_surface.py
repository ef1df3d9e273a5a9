"""The tutorial of the documentation in Python: a measured surface passes the gear contact, and its fatigue.

python profiles/examples/measured_surface.py [FOLDER [KEY=VALUE ...]]     (KEY=VALUE: changes of the scene, grid.nx=64 say)
"""

import shutil
import sys
from pathlib import Path

import numpy as np
from make_scan import scan

import tehl_taichi as tehl

folder, changes = Path(sys.argv[1] if len(sys.argv) > 1 else "."), dict(word.split("=") for word in sys.argv[2:])
np.savetxt(folder / "scan.csv", scan(), delimiter=",", fmt="%.1f")
shutil.copy(Path(__file__).with_name("my_flank.toml"), folder)

scene = tehl.scene(folder / "my_flank.toml").replace(**{"grid.nx": 128, "grid.ny": 32})
scene = scene.replace(**{key: float(value) if "." in value else int(value) for key, value in changes.items()})
run = tehl.run(scene, folder / "my_flank.zarr", progress=tehl.Lines())
fatigue = run.summary["fatigue"]
print(f"Fi {fatigue['Fi_max']:.2f} at x = {fatigue['x_m'] * 1e6:.0f}, y = {fatigue['y_m'] * 1e6:.0f} um of the patch")
for warning in run.warnings:
    print(f"warning: {warning}")
print(f"Fi with kappa 0.4: {run.fatigue(kappa=0.4).summary['Fi_max']:.2f}")
