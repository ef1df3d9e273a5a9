"""The store between two checkpoints."""

import numpy as np
import pytest
from small_stores import SMALL, shot, store

from tehl_taichi.scene import scene


def test_entries_after_the_last_checkpoint_come_again_the_same(taichi_cpu, tmp_path):
    from tehl_taichi.march.passage import march
    from tehl_taichi.store.store import Store

    description = scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 5})
    run = march(description)
    saved = Store.create(tmp_path / "one.zarr", description, next(run), 6)
    for entry in run:
        saved.append(entry, entry.state if entry.step == 2 else None)
    before = [saved.fields(n)["film"] for n in range(6)]
    state = saved.go_back()
    assert len(saved) == 3 and int(state["step"]) == 2 and len(Store.open(saved.path)) == 3
    for entry in march(description, state):
        saved.append(entry)
    assert len(saved) == 6 and all(np.array_equal(saved.fields(n)["film"], film) for n, film in enumerate(before))


def test_due_once_in_a_while_and_at_the_last_step(monkeypatch):
    from tehl_taichi.runs import recorder

    now = iter([0.0, 1.9, 2.1, 2.1, 3.0, 9.9])
    monkeypatch.setattr(recorder.time, "monotonic", lambda: next(now))
    due = recorder.Interval(2.0, 4)
    assert [due.at(step) for step in (1, 2, 3, 4)] == [False, True, False, True]


def test_entries_are_shown_together_or_with_a_state(tmp_path):
    from tehl_taichi.store.store import Store

    with Store.write(store(tmp_path / "s.zarr", entries=1).path) as saved:
        for step, state, seen in ((1, False, 1), (2, False, 1), (3, True, 4), (4, False, 4)):
            saved.append(shot(step), shot(step).state if state else None, shown=False)
            assert len(saved) == step + 1 and len(Store.open(saved.path)) == seen
        saved.show()
    assert Store.open(saved.path).scalar("step").tolist() == [0, 1, 2, 3, 4]


def test_fields_of_stores_before_layout_3_are_found(tmp_path):
    import json

    from tehl_taichi.store.store import Store

    root = store(tmp_path / "old.zarr").path / "zarr.json"
    content = json.loads(root.read_text())
    content["attributes"]["format"] = 2
    content["consolidated_metadata"]["metadata"]["film"]["chunk_key_encoding"]["configuration"]["separator"] = "/"
    root.write_text(json.dumps(content))
    folder = root.parent / "film" / "c" / "2" / "0"
    folder.mkdir(parents=True)
    (root.parent / "film" / "c.2.0.0").rename(folder / "0")
    saved = Store.open(root.parent)
    assert saved.fields(2)["film"][0, 0] == 3.5 and "layout 2" in saved.other_version


def test_what_a_stopped_run_computed_is_shown(tmp_path, monkeypatch):
    from tehl_taichi.runs import recorder
    from tehl_taichi.store.store import Store

    def stops(scene, state, changes):
        yield from (shot(step) for step in (1, 2, 3))
        raise ArithmeticError("step 4")

    monkeypatch.setattr(recorder, "march", stops)
    monkeypatch.setattr(recorder.Thinned, "of", lambda thinned, snapshot: snapshot)  # made-up ones are of another kind
    with Store.write(store(tmp_path / "s.zarr", entries=1).path) as saved, pytest.raises(ArithmeticError):
        recorder.march_on(saved, None)
    assert len(Store.open(saved.path)) == 4


def test_the_group_lists_its_arrays_as_their_own_files_describe_them(tmp_path):
    """A writer knows them; none is read back. Coordinates of a new store are those that readers find."""
    import json

    from tehl_taichi.store.store import Store

    def described(path):
        own = {file.parent.name: json.loads(file.read_text()) for file in sorted(path.glob("*/zarr.json"))}
        for array in own.values():
            array["shape"][0] = 2 if array["dimension_names"][0] == "time" else array["shape"][0]
        return own

    def listed(path):
        return json.loads((path / "zarr.json").read_text())["consolidated_metadata"]["metadata"]

    with Store.create(tmp_path / "s.zarr", SMALL, shot(0), 9, {"steady_error": "{}"}) as saved:
        saved.append(shot(1), shot(1).state)
        assert list(listed(saved.path)) == sorted(listed(saved.path)) and listed(saved.path) == described(saved.path)
        saved.finish({"warnings": []}, {"fi": (np.ones((2, 3)), ["x", "y"], "1", "index")})
        assert listed(saved.path) == described(saved.path) and "fi" in listed(saved.path)
        found = Store.open(saved.path)
        assert np.array_equal(found.x, saved.x) and np.array_equal(found.y, saved.y) and found.x.dtype == saved.x.dtype
