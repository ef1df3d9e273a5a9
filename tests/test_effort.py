"""The work of five scenes: Newton and Krylov iterations a step, from both sides.

Less would be welcome, but somebody should know why: whoever changes the solver writes the new counts here. More is a Jacobian
or a preconditioner that has lost something (weights of the coarser grids, a derivative), or a worse guess for the next step.
"""

import numpy as np
import pytest

from tehl_taichi.scene import scene

# Newton steps and Krylov iterations: of the steady start, and a step (mean of the steps taken); None: there is none, or with
# temperatures only the last of its solves
COUNTS = {
    "gear, isothermal": ((5, 74), (2.13, 14.1)),
    "gear, thermal": (None, (3.38, 22.6)),
    "touching asperity": ((5, 61), (3.33, 18.8)),
    "steady circle": ((5, 42), None),
    "ridge on ball": ((5, 42), (2.5, 15.0)),
}
WITHIN = 0.10  # the precision of the linear solves moves them by 2 %

NEWTONIAN = {"thermal.on": False, "rheology.law": "newtonian"}
SCENES = {
    "gear, isothermal": scene("gear").replace(**{**NEWTONIAN, "grid.nx": 128, "grid.ny": 32, "time.steps": 48}),
    "gear, thermal": scene("gear").replace(**{"thermal.on": True, "grid.nx": 64, "grid.ny": 16, "time.steps": 16}),
    "touching asperity": scene("touching-asperity").replace(**{**NEWTONIAN, "grid.nx": 64, "grid.ny": 16, "time.steps": 30}),
    "steady circle": scene("ball-on-disc").replace(**{**NEWTONIAN, "grid.nx": 64, "grid.ny": 32}),
    "ridge on ball": scene("ridge-on-ball").replace(**{**NEWTONIAN, "srr": 0.0, "grid.nx": 64, "grid.ny": 32,
                                                      "time.steps": 16}),
}


@pytest.mark.parametrize("name", COUNTS)
def test_work_is_what_it_was(taichi_cpu, name):
    from tehl_taichi.march.passage import march

    start, *steps = [[s.scalars[key] for key in ("newton", "cycles", "residual", "mass_error")] for s in march(SCENES[name])]
    assert max(s[2] for s in (start, *steps)) < 1e-6 and max(s[3] for s in (start, *steps)) < 1e-6
    found = start[:2], np.mean(steps, axis=0)[:2] if steps else None
    print(f"now: {name}: {found}")  # shown when the test fails: the line of the table above
    for counts, known in zip(found, COUNTS[name]):
        assert known is None or counts == pytest.approx(known, rel=WITHIN)
