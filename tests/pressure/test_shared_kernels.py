"""Grids of a start, its passage and its companions run by the same kernels: each more takes 0.1 s to trace and load."""

import numpy as np
import pytest

from tehl_taichi.engine import field_pool, runtime
from tehl_taichi.march.accuracy import coarse_runs
from tehl_taichi.march.passage import march
from tehl_taichi.pressure import balances, deflection, reynolds
from tehl_taichi.pressure.linear import line_solver, transfer
from tehl_taichi.scene import scene

KERNELS = (deflection.bend, transfer.inject, reynolds.residual, reynolds.linearise, line_solver.classify,
           line_solver.build_lines, balances.sums)
GEAR = scene("gear").replace(**{"grid.nx": 128, "grid.ny": 32, "thermal.on": False, "time.steps": 8})


def traced():
    return {kernel.__name__: len(kernel._primal.compiled_kernels) for kernel in KERNELS}


def test_a_passage_and_its_companions_need_no_kernels_beyond_those_of_the_start(taichi_cpu):
    shots = march(GEAR)
    next(shots)
    of_start = traced()
    next(shots)
    assert traced() == of_start
    shots.close()
    coarse_runs.answers(GEAR)
    assert traced() == of_start


def test_loops_run_as_larger_ones_inside_alone(taichi_cpu, monkeypatch):
    monkeypatch.setitem(runtime._started, "threads", 2)
    work = runtime.WORTH_THREADS / 3
    with pytest.raises(ZeroDivisionError), runtime.grown(4):
        assert not runtime.alone(work)
        raise ZeroDivisionError
    assert runtime.alone(work)


def test_snapshots_that_are_kept_leave_their_tables_to_the_next_march(taichi_cpu):
    """Of a march that has ended, with the state of its last snapshot."""
    description = scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 3})
    kept = list(march(description))
    before = len(field_pool._tables)
    again = list(march(description))
    assert len(field_pool._tables) == before
    for one, other in zip(kept[3].state.values(), again[3].state.values()):
        np.testing.assert_array_equal(one, other)
    with pytest.raises(RuntimeError, match="state of step 2 is no longer available"):
        print(kept[2].state)
