# %% [markdown]
# # Five typical jobs
# Open this file in an editor that runs cells (VS Code, Spyder, Jupyter with jupytext), or run it:
# `python profiles/examples/five_jobs.py`. The grid is coarse and the passage short, so that all cells take seconds;
# for results use 256 x 64 cells and leave out `time.steps`.

# %%
import tempfile
from pathlib import Path

import numpy as np

import tehl_taichi as tehl

folder = Path(tempfile.mkdtemp())
small = {"grid.nx": 64, "grid.ny": 16, "time.steps": 3, "thermal.on": False, "fatigue.depths": []}

# %% [markdown]
# ## 1 · A run and its error bars
# `numerics.estimate_error` adds two runs on coarser grids. A number without an error gives the reason.

# %%
gear = tehl.scene("gear").replace(srr=-0.12, **small, **{"numerics.estimate_error": True})
run = tehl.run(gear, folder / "gear.zarr")
for name in ("steady.h_c", "steady.p_max", "transient.h_min", "fatigue.Fi_max"):
    print(f"{name}: {run[name]}")
for warning in run.warnings:
    print(f"warning ({warning.code}): {warning}")

# %% [markdown]
# ## 2 · Your own scan
# Heights from an array in m, rows along y. `level="plane"` removes the tilt, `taper` fades the rim out.

# %%
y, x = np.mgrid[-20:21, -40:41] * 5e-6
heights = 0.8e-6 * np.exp(-(x**2 + y**2) / (2 * 35e-6**2)) + 2e-3 * x
scan = tehl.Feature.from_heights(heights, pixel=5e-6, level="plane", taper=20e-6)
measured = tehl.run(gear.replace(feature=[scan], **{"numerics.estimate_error": False}), folder / "scan.zarr")
print(f"scan: range {scan.measures.range * 1e6:.2f} um, Fi {measured['Fi_max'].value:.2f}")

# %% [markdown]
# ## 3 · Your own oil and shear law
# Values of a data sheet, and the constants of a shear law (`tehl laws` lists the laws and their constants). A law of your
# own is a file of twenty lines: see "One file for one idea" in CONTRIBUTING.md.

# %%
oil = {"oil.name": "my oil", "oil.nu_40": 150e-6, "oil.nu_100": 18e-6, "oil.rho_15": 870.0}  # m2/s, kg/m3
law = {"rheology.law": "limiting", "rheology.tau_L0": 8e6, "rheology.gamma": 0.06}
other = tehl.run(gear.replace(**oil, **law, **{"time.steady_only": True}), folder / "oil.zarr")
print(f"own oil: h_c {other['h_c']}, friction {other['friction_coefficient']}")

# %% [markdown]
# ## 4 · A sweep
# One store for all cases; a table of numbers, figures with `study.plot()`.

# %%
study = tehl.sweep(gear.replace(**{"time.steady_only": True, "numerics.estimate_error": False}),
                   {"srr": [-0.2, 0.1], "speed": [5.0, 10.0]}, folder / "study.zarr", workers=1)
for case, film in zip(study.results(), study.values["steady_h_c_m"]):
    print(case["changes"], f"h_c {film * 1e9:.0f} nm")

# %% [markdown]
# ## 5 · Stresses of given tractions
# A Hertz pressure with friction 0.1 on a half-space: sigma_xx behind the contact, and the largest shear stress below it.

# %%
step, a = 10e-6, 0.3e-3
x = np.arange(-100, 101) * step
pressure = 1.5e9 * np.sqrt(np.maximum(0.0, 1 - (x / a) ** 2))
stress = tehl.stresses(pressure, 0.1 * pressure, dx=step, depths=[0.0, 0.78 * a])  # (x, depths, 6): xx, yy, zz, xy, xz, yz
shear = np.hypot((stress[..., 0] - stress[..., 2]) / 2, stress[..., 4])
print(f"sigma_xx at the surface: {stress[:, 0, 0].max() / 1e6:.0f} MPa; shear at z = 0.78 a: {shear[:, 1].max() / 1e6:.0f} MPa")
