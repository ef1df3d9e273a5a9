"""What Newton keeps from one solve of a step to the next."""

import numpy as np
import pytest
from pressure.linear.test_solver import pressed

from tehl_taichi.pressure import fields
from tehl_taichi.pressure.newton import SAME_SLOPES, SMALL_CHANGE


@pytest.mark.parametrize("keeps, evaluated", [(True, 0), (False, 1)])
def test_slopes_are_kept_from_the_first_solve_with_a_small_change_on(taichi_cpu, monkeypatch, keeps, evaluated):
    """Also where the step began with a large one. A solve beside its solution takes one Newton step."""
    solver = pressed("f64", "jacobi")
    assert solver.solve().converged
    levels, slopes, seen = solver.levels, solver.equations.film.slopes, []
    levels.put(fields.P, levels.get(fields.P) * (1 + 0.2 * np.cos(3 * levels.X)))
    monkeypatch.setattr(solver.equations.film, "slopes", lambda: seen.append(slopes()))
    solver.improve(keeps)
    assert solver.change > SMALL_CHANGE and not solver.kept
    assert solver.solve().converged and solver.change < SAME_SLOPES
    before = len(seen)
    assert solver.solve().newton == 1 and len(seen) - before == evaluated
