"""The store between two checkpoints."""

import numpy as np

from tehl_taichi.scene import scene


def test_entries_after_the_last_checkpoint_come_again_the_same(taichi_cpu, tmp_path):
    from tehl_taichi.io.store import Store
    from tehl_taichi.march.passage import march

    description = scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 5})
    run = march(description)
    saved = Store.create(tmp_path / "one.zarr", description, next(run), 6)
    for shot in run:
        saved.append(shot, shot.state if shot.step == 2 else None)
    before = [saved.fields(n)["film"] for n in range(6)]
    state = saved.go_back()
    assert len(saved) == 3 and int(state["step"]) == 2 and len(Store.open(saved.path)) == 3
    for shot in march(description, state):
        saved.append(shot)
    assert len(saved) == 6 and all(np.array_equal(saved.fields(n)["film"], film) for n, film in enumerate(before))


def test_one_state_in_a_while_and_the_last_one(monkeypatch):
    from tehl_taichi.study import recorder

    class Shot:
        def __init__(self, step):
            self.step, self.state = step, {"step": step}

    now = iter([0.0, 1.9, 2.1, 2.1, 3.0, 9.9])
    monkeypatch.setattr(recorder.time, "monotonic", lambda: next(now))
    states = recorder.Checkpoints(4)
    assert [states.of(Shot(step)) for step in (1, 2, 3, 4)] == [None, {"step": 2}, None, {"step": 4}]
