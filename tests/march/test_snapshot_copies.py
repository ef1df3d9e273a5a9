"""Snapshots and results in other processes and in comparisons: no arrays behind ==, no solver inside a pickle."""

import copy
import pickle

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.march.snapshot import StateGone

SCENE = tehl.scene("gear").replace(**{"grid.nx": 32, "grid.ny": 8, "thermal.on": False, "time.steps": 2})


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
def test_a_snapshot_can_be_sent_to_another_process(copied):
    """With its state if it was read, from which a march continues there."""
    march = tehl.march(SCENE)
    next(march)
    first = next(march)
    sent = copied(first)
    assert np.array_equal(sent.fields["film"], first.fields["film"]) and repr(sent) == repr(first) and sent.step == 1
    with pytest.raises(StateGone):
        _ = sent.state
    assert first.state["step"] == 1 and copied(first).state.keys() == first.state.keys()  # the original still has its solver
    second, again = next(march), next(tehl.march(SCENE, copied(first).state))
    assert np.array_equal(second.fields["pressure"], again.fields["pressure"]) and again.step == 2


@pytest.mark.parametrize("made", [lambda: tehl.fatigue(np.zeros((2, 3, 6))),
                                  lambda: tehl.Snapshot(0, 0.0, 0.0, np.zeros(3), np.zeros(2), {}, {}, dict)])
def test_results_with_arrays_are_compared_without_an_error(made):
    one, other = made(), made()
    assert one == one and one != other and one in [other, one] and len({one, other}) == 2
