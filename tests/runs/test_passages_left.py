"""The remaining time of several passages, read from their stores while other processes write them."""

import re

import pytest

import tehl_taichi as tehl
from tehl_taichi.errors import typed_options
from tehl_taichi.runs import passages_left
from tehl_taichi.runs.passages_left import PassagesLeft, announced
from tehl_taichi.scene.timeline import total_steps

SMALL = {"grid.nx": 64, "grid.ny": 16}


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(passages_left.time, "monotonic", lambda: now[0])
    return now


@pytest.fixture
def stored(monkeypatch):
    """{path: last step in its store}."""
    steps = {}
    monkeypatch.setattr(passages_left, "_last_step", lambda path: steps.get(path, 0))
    monkeypatch.setattr(passages_left, "_ended", lambda path: path == "ended")
    return steps


def test_the_time_left_follows_the_work_in_all_stores(clock, stored):
    """Two passages, the second with four times the nodes: a step of it counts four times; compilation does not count."""
    small, large = tehl.scene("gear").replace(**SMALL), tehl.scene("gear").replace(**SMALL, name="large")
    large = large.replace(**{"grid.nx": 128, "grid.ny": 32})
    said = []
    left = PassagesLeft([(small, "a"), (large, "b"), (small.replace(**{"time.steady_only": True}), "c")], said.append)
    clock[0] += 60.0
    left.tick()
    assert not said  # nothing is stored yet
    stored["a"] = 2
    clock[0] += 20.0
    left.tick()
    assert said == [f"gear step 2 of {total_steps(small)}"]
    stored.update(a=total_steps(small), b=1)
    clock[0] += 100.0
    left.tick()
    nodes = 65 * 9, 129 * 17
    done = nodes[0] * (total_steps(small) - 2) + nodes[1]
    seconds = 100.0 / done * nodes[1] * (total_steps(large) - 1)
    assert said[1] == ("gear stresses and error bars; "
                       f"large step 1 of {total_steps(large)}; {passages_left.about(seconds)} left for 2 passages")
    assert passages_left._state(small, "ended", total_steps(small)) == passages_left._state(small, "a", 0) == ""
    left.tick()
    assert len(said) == 2  # not more often than every EVERY seconds


def test_passages_are_announced_with_shorter_ways():
    long = [tehl.scene("gear"), tehl.scene("gear").replace(**{"time.steps": 150})]
    counts = sorted(total_steps(scene) for scene in long)
    line, = announced(long)
    assert line.startswith(f"2 passages of {counts[0]} to {counts[1]} steps on 256x64 cells; ")
    assert re.search(r"Shorter: time.steady_only=True, without passages; grid.nx=128 and grid.ny=32, 0\.1[234] times the", line)
    with typed_options():
        assert re.search(r"Shorter: --steady, without passages; --grid 128x32, 0\.1[234] times the work", *announced(long))
    assert announced([scene.replace(**SMALL, **{"thermal.on": False}) for scene in long[:1]])[0].endswith(" on 64x16 cells")
    assert announced([scene.replace(**{"time.steady_only": True}) for scene in long]) == []
    line, = announced([tehl.scene("furrow-line")] * 400)
    assert "x" not in re.search(r"grid.nx=(\S+),", line)[1]


def test_steps_are_read_from_a_store_that_another_process_writes(tmp_path, taichi_cpu):
    scene = tehl.scene("gear").replace(**SMALL, **{"thermal.on": False, "fatigue.on": False, "time.steps": 3})
    assert passages_left._last_step(tmp_path / "none.zarr") == 0 and not passages_left._ended(tmp_path / "none.zarr")
    tehl.run(scene, tmp_path / "a.zarr")
    assert passages_left._last_step(tmp_path / "a.zarr") == 3 and passages_left._ended(tmp_path / "a.zarr")
