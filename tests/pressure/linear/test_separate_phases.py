"""Each phase of the linear solve as a launch of its own, as a graphics card does it: the same bits.

In a file of its own: one solver at a time, by the tables that others have left.
"""

import pytest
from pressure.linear.test_solver import pressed, solved

from tehl_taichi.engine import runtime, task_pool


@pytest.mark.parametrize("precision, sweep", [("f64", "jacobi"), pytest.param("f32", "jacobi", marks=pytest.mark.slow),
                                              pytest.param("f64", "red-black", marks=pytest.mark.slow)])
def test_each_phase_as_a_launch_of_its_own_gives_the_same_bits(taichi_cpu, monkeypatch, precision, sweep):
    """From the first film on."""
    right, *whole, phases = answer(precision, sweep)
    monkeypatch.setattr(runtime, "by_phases", lambda: True)
    monkeypatch.setenv("TEHL_CELLS", "0")
    ran = []
    same_right, *parts, _ = answer(precision, sweep, ran)
    assert same_right == right and parts == whole and whole[2] > 5
    assert len(ran) > 10 * whole[2] and len(set(ran)) <= phases


def answer(precision, sweep, ran=None):
    """Bytes of the right-hand side and of the solution, what else `solved` returns, and the number of phases; ran: takes the
    phases that are launched."""
    krylov = pressed(precision, sweep).linear.krylov
    launch = krylov._launch
    if ran is not None:
        krylov._launch = lambda: (ran.append(int(krylov.team.sync[task_pool.TICKET])), launch())
    right = krylov.right.copy()
    x, *rest = solved((krylov, right), 1e-3)
    return right.tobytes(), x.tobytes(), *rest, len(krylov.program.phases)
