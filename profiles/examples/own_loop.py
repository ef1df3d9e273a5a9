"""Your own loop over a passage: where the largest pressure lies while a dent passes, and how thick the film is there.

python profiles/examples/own_loop.py [STEPS]
"""

import sys

import numpy as np

import tehl_taichi as tehl

scene = tehl.scene("dent").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False,
                                      "time.steps": int(sys.argv[1]) if len(sys.argv) > 1 else 20})
for snapshot in tehl.march(scene):
    p, film = snapshot.fields["pressure"], snapshot.fields["film"]  # (nx+1, ny+1), Pa and m
    i, j = np.unravel_index(p.argmax(), p.shape)
    print(f"step {snapshot.step}: dent at {snapshot.feature_x * 1e3:.3f} mm, {p.max() / 1e9:.3f} GPa at "
          f"x = {snapshot.x[i] * 1e3:.3f} mm, y = {snapshot.y[j] * 1e3:.3f} mm under {film[i, j] * 1e6:.3f} um of oil")
