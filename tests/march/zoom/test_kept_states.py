"""States of a march that are kept in memory."""

import numpy as np
import pytest

from tehl_taichi.march.zoom import kept_states, marched_heat
from tehl_taichi.march.zoom.kept_states import KeptStates


def kept(steps, size=10):
    found = KeptStates({"step": 0, "T": np.zeros(size)})
    for step in steps:
        found.add({"step": step, "T": np.zeros(size)})
    return found


def test_they_thin_out_but_for_the_first():
    found = kept(range(1, 40))
    steps = [state["step"] for state in found.states]
    assert steps[0] == 0 and len(steps) <= kept_states.MOST and steps == sorted(steps) and steps[-1] > 30


def test_large_ones_are_few(monkeypatch):
    monkeypatch.setattr(kept_states, "BYTES", 8 * 10 * 3.5)
    assert len(kept(range(1, 40)).states) <= 3
    monkeypatch.setattr(kept_states, "BYTES", 1.0)
    assert [state["step"] for state in kept(range(1, 40)).states] == [0]


def test_the_newest_before_a_step():
    found = kept((5, 9, 14))
    assert [found.before(step)["step"] for step in (4, 5, 13, 20)] == [0, 5, 9, 14]
    assert found.start["step"] == 0 and KeptStates({"step": 3}).start is None
    assert KeptStates({"step": 3}).before(2) is None


def heat(value):
    return {"heat_T": np.full(4, value), "heat_memory": np.zeros(6), "heat_offset": np.zeros(2)}


def test_the_newest_temperatures_are_kept_as_far_as_there_is_room(monkeypatch):
    monkeypatch.setattr(kept_states, "HEAT_BYTES", 4 * 10 * 3.5)
    found = KeptStates({"step": 0})
    for step in range(1, 9):
        found.add_heat(step, heat(float(step)))
    assert {step: one.T[0] for step, one in found.heats.items()} == {6: 6.0, 7: 7.0, 8: 8.0}


def test_kept_temperatures_are_not_marched_again(monkeypatch):
    """And both have single precision."""
    found = KeptStates({"step": 0, **heat(1 / 3)})
    found.add_heat(3, heat(1 / 3))
    monkeypatch.setattr(marched_heat, "march", lambda *_, **__: iter(()))
    marched = marched_heat.MarchedHeat(None, kept=found)
    assert float(marched.at(0).T[0]) == float(marched.at(3).T[0]) == float(np.float32(1 / 3))
    with pytest.raises(StopIteration):
        marched.at(2)


@pytest.mark.parametrize("start, first, held", [(0, 1, {0, 1, 5}), (0, 3, {3, 5}), (2, 3, {3, 5}), (2, 1, {1, 5})])
def test_states_can_be_read_several_times_if_all_are_kept(start, first, held):
    """Those that a march begins with at step 0 are kept, too."""
    found = KeptStates({"step": start, **heat(1.0)})
    for step in range(first, 6):
        found.add_heat(step, heat(1.0))
    marched = marched_heat.MarchedHeat(None, kept=found)
    assert {step for step in (0, 1, 3, 5) if marched.holds(step)} >= held
    assert marched.holds(0) == (0 in held) and marched.holds(1) == (1 in held)
