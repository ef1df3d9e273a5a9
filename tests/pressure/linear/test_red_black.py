"""Lines of the finest level in two colours: the second one has what the first one, and coarser levels, leave."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from pressure.linear.test_solver import pressed

from tehl_taichi.engine.simd import OFF, W
from tehl_taichi.errors import SceneError
from tehl_taichi.march.passage import march
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.linear import schedule
from tehl_taichi.pressure.linear.solver import Krylov
from tehl_taichi.pressure.newton import pressure_solver
from tehl_taichi.scene import scene

pytestmark = pytest.mark.usefixtures("taichi_cpu")


class Once:
    """What a preconditioner answers to a right-hand side (scaled rows): all of it, or the finest level alone."""

    def __init__(self, krylov):
        self.krylov, p = krylov, krylov.program
        self.whole = p._fine(schedule.START, schedule.BEGIN)
        p._precondition(schedule.END)
        self.finest = p._fine(schedule.START, schedule.BEGIN)
        for jobs in (p._pairs(schedule.LINES, 1), p._groups(1), p._pairs(schedule.COLLECT, 1)):
            p._phase(jobs)
        p._phase(p._blocks(schedule.FINEST, 0, 0), schedule.END)
        p.jobs, p.phases = (np.array(table, np.int32) for table in (p._jobs, p._phases))
        krylov._bind()

    def answer(self, right, phase):
        k, v = self.krylov, self.krylov.levels
        k.right[:] = right
        k._run(phase)
        first = int(v.G[0, OFF])
        return k.memory.J.to_numpy()[fields.COR, first : first + v.n // W].ravel()


@pytest.fixture(scope="module")
def both(taichi_cpu):
    """A linear problem and its preconditioners of one colour and of two: (right-hand side, row of each number, Once, Once)."""
    solver = pressed("f64", "jacobi")
    one, v = solver.linear.krylov, solver.levels
    right, rows = one.right.copy(), np.arange(v.n) // W // (v.nx + 1) * W + np.arange(v.n) % W
    v.scene = dataclasses.replace(v.scene, numerics=dataclasses.replace(v.scene.numerics, sweep="red-black"))
    two = Krylov(v)
    two.dense[:] = one.dense
    two._fill_dense()
    return right, rows, Once(one), Once(two)


def test_the_second_colour_answers_what_the_first_leaves(both):
    right, rows, one, two = both
    red, black = (rows % 2 == 0) * 1.0, (rows % 2 == 1) * 1.0
    found = two.answer(right, two.whole)
    first = one.answer(right, one.whole) - one.answer(right * black, one.finest)
    rest = right - one.krylov.apply(first, 0.0)
    exact = first + one.answer(rest * black, one.finest)
    np.testing.assert_allclose(found, exact, atol=1e-9 * np.abs(exact).max())
    assert np.abs(exact - one.answer(right, one.whole)).max() > 0.01 * np.abs(exact).max()
    assert np.abs(one.answer(right * red, one.finest)).max() > 0


@pytest.mark.slow
def test_they_settle_in_the_same_state():
    """A whole start and some steps."""
    shots = []
    for sweep in ("jacobi", "red-black"):
        description = scene("gear").replace(**{"thermal.on": False, "grid.nx": 64, "grid.ny": 16, "time.steps": 3,
                                               "numerics.sweep": sweep})
        shots.append(list(march(description))[-1])
    one, other = (shot.fields["pressure"] for shot in shots)
    np.testing.assert_allclose(one, other, atol=1e-4 * one.max())
    assert shots[0].scalars["cycles"] != shots[1].scalars["cycles"]


def test_cells_have_no_second_colour(monkeypatch):
    monkeypatch.setenv("TEHL_CELLS", "1")
    levels = SimpleNamespace(scene=scene("gear").replace(**{"numerics.sweep": "red-black"}))
    with pytest.raises(SceneError, match="red-black.*allowed here: jacobi"):
        pressure_solver(levels, None)
