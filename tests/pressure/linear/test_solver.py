"""The linear solve as one kernel: the same bits by any number of workers, solutions of its equations, odd right-hand sides."""

import subprocess
import sys

import numpy as np
import pytest

from tehl_taichi.engine import cores
from tehl_taichi.engine.task_pool import PATIENCE
from tehl_taichi.march.steady import solve_steady
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.linear.gmres import PORTION, SCALARS
from tehl_taichi.scene import scene

LOAD = 0.03


def pressed(precision, sweep):
    """Solver of a steady contact pressed together a little, with its linear problem."""
    description = scene("gear").replace(**{"thermal.on": False, "rheology.law": "newtonian", "grid.nx": 64, "grid.ny": 16,
                                           "numerics.precision": precision, "numerics.sweep": sweep})
    solver = solve_steady(description, 64, 16).solver
    solver.H0 -= 0.003
    solver._begin()
    solver._direction(0.1)
    return solver


TWO_COLOURS = pytest.param(("f64", "red-black"), marks=pytest.mark.slow)  # the answers of the second: test_red_black.py


@pytest.fixture(scope="module", params=(("f32", "jacobi"), ("f64", "jacobi"), TWO_COLOURS), ids="-".join)
def problem(request, taichi_cpu):
    """A linear problem: (its solver, right-hand side)."""
    krylov = pressed(*request.param).linear.krylov
    return krylov, krylov.right.copy()


def outflow(problem):
    """Of the right-hand side: a component that follows from the others."""
    return float(problem[0].outflow @ problem[1])


def solved(problem, tolerance):
    krylov, right = problem
    krylov.right[:] = right
    rise, count, left = krylov.solve(LOAD, outflow(problem), tolerance)
    return krylov.out.copy(), rise, count, left


@pytest.mark.parametrize("size, patience", ((2, 10**6), (2, 0), (3, 50), (7, 10**4)))
def test_the_same_bits_by_any_number_of_workers(problem, size, patience):
    """Also by those who leave in the middle, and by more than there are threads."""
    team, results = problem[0].team, []
    before = team.size, team.sync[PATIENCE]
    for team.size, team.sync[PATIENCE] in ((1, 10**6), (size, patience)):
        team.alone = 0
        results.append(solved(problem, 1e-3))
    team.size, team.sync[PATIENCE] = before
    (x, *rest), (y, *others) = results
    assert x.tobytes() == y.tobytes() and rest == others and rest[1] > 5


def test_the_same_bits_beside_others_on_all_cores(problem):
    """And workers that come back, after a while, where they had fallen back to one."""
    whole = solved(problem, 1e-3)
    hogs = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(2 * len(cores.allowed()))]
    try:
        beside = [solved(problem, 1e-3) for _ in range(20)]
    finally:
        for hog in hogs:
            hog.kill()
            hog.wait()
    for x, *rest in beside:
        assert x.tobytes() == whole[0].tobytes() and tuple(rest) == whole[1:]


@pytest.mark.parametrize("portion", (1, 4))
def test_the_same_bits_in_portions(problem, monkeypatch, portion):
    """A solve that is cut into several launches, between which Ctrl-C is heard."""
    krylov, ran = problem[0], []
    whole, usual, run = solved(problem, 1e-3), krylov.numbers[SCALARS, PORTION], krylov.team.run
    monkeypatch.setattr(krylov.team, "run", lambda *args: (ran.append(1), run(*args)))
    krylov.numbers[SCALARS, PORTION] = portion
    cut = solved(problem, 1e-3)
    krylov.numbers[SCALARS, PORTION] = usual
    assert cut[0].tobytes() == whole[0].tobytes() and cut[1:] == whole[1:]
    assert len(ran) == -(-whole[2] // portion) > 1


def test_the_solution_has_the_residual_that_it_is_said_to_have(problem):
    """Rows, load and net outflow, computed from the solution."""
    (krylov, b), tolerance = problem, {"f32": 1e-4, "f64": 1e-10}[problem[0].levels.precision]
    x, rise, count, left = solved(problem, tolerance)
    assert 5 < count < krylov.most and left <= tolerance
    rows = krylov.apply(x, rise).astype(float)
    outflows = outflow(problem) - krylov.outflow.astype(float) @ rows
    rest = np.append(b - rows, [LOAD - krylov.levels.vector(fields.WEIGHT) @ x, outflows])
    norm = np.sqrt(b.astype(float) @ b + LOAD**2 + outflow(problem) ** 2)
    assert np.sqrt(rest @ rest) == pytest.approx(left * norm, rel=0.2)


def test_no_right_hand_side_no_step(problem):
    krylov = problem[0]
    krylov.right[:] = 0.0
    rise, count, left = krylov.solve(0.0, 0.0, 0.1)
    assert rise == left == 0.0 and not krylov.out.any() and count == 1


def test_not_a_number_ends_a_solve(problem):
    krylov = problem[0]
    krylov.right[:] = np.nan
    assert krylov.solve(0.0, 0.0, 0.1)[1] == 1


def test_iterations_end_at_their_most(problem):
    x, rise, count, left = solved(problem, 1e-30)
    assert count == problem[0].most and 0 < left < 1e-4 and np.isfinite(x).all()
