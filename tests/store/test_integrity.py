"""Damaged, edited, old and full stores: a sentence that names the file, never numbers, never Python's words."""

import json
import pickle
import re
import shutil

import numpy as np
import pytest
from small_stores import SMALL, shot, store

from tehl_taichi import __version__
from tehl_taichi.disk import files
from tehl_taichi.errors import INTERRUPTED, Interrupted, StoreError
from tehl_taichi.march.step_output import Scalar, entries
from tehl_taichi.scene import scene
from tehl_taichi.store.load_scene import find
from tehl_taichi.store.store import Store


@pytest.fixture(scope="module")
def template(tmp_path_factory):
    return store(tmp_path_factory.mktemp("template") / "a.zarr").path


@pytest.fixture
def path(template, tmp_path):
    return shutil.copytree(template, tmp_path / "a.zarr")


def edit(path, **changes):
    """Change attributes of a store by hand; None takes one away."""
    root = json.loads((path / "zarr.json").read_text())
    root["attributes"].update(changes)
    root["attributes"] = {key: value for key, value in root["attributes"].items() if value is not None}
    (path / "zarr.json").write_text(json.dumps(root))


def without(section):
    return json.dumps({key: value for key, value in SMALL.to_dict().items() if key != section})


@pytest.mark.parametrize("changes, said", [
    ({"steps": None}, "'steps'"), ({"steps": "3"}, "'steps'"), ({"steps": 0}, "'steps'"), ({"steps": -3}, "'steps'"),
    ({"finished": None}, "'finished'"), ({"finished": "yes"}, "'finished'"), ({"scene": None}, "describes no scene"),
    ({"scene": "[]"}, "scene.*cannot be read"), ({"scene": "gear"}, "scene.*cannot be read"),
    ({"scene": without("grid")}, "scene.*cannot be read"),
    ({"scene": json.dumps(SMALL.replace(**{"grid.nx": 64}).to_dict())}, r"contact has the shape \[3, 33, 9\].*\[3, 65, 9\]"),
    ({"scene": json.dumps(SMALL.replace(**{"thermal.on": True}).to_dict())}, "no array 'temperature_a'"),
    ({"steps": 49}, "49")])
def test_attributes_that_do_not_belong_together(path, changes, said):
    edit(path, **changes)
    with pytest.raises(StoreError, match=said):
        Store.open(path)


@pytest.mark.parametrize("text", ["[]", "{}", "", "{", "null", '{"attributes": []}', '{"attributes": {"scene": "{}"}}'])
def test_a_zarr_json_of_something_else(path, text):
    (path / "zarr.json").write_text(text)
    with pytest.raises(StoreError, match="is not a store of tehl run"):
        Store.open(path)


@pytest.mark.parametrize("name", ["feature_x", "p_max_Pa", "step", "time"])
def test_a_series_is_checked_before_it_is_shown(path, name):
    file = path / name / "c" / "0"
    whole = file.read_bytes()
    rng = np.random.default_rng(1)
    for content in (rng.bytes(len(whole)), whole[: len(whole) // 2], whole[:-1] + bytes([whole[-1] ^ 1]), b""):
        file.write_bytes(content)
        with pytest.raises(StoreError, match=rf"{name}/c/0 is damaged"):
            Store.open(path)
    file.unlink()
    with pytest.raises(StoreError, match=rf"{name}/c/0 is missing"):
        Store.open(path)
    shutil.rmtree(path / name)
    with pytest.raises(StoreError, match=rf"{name}/c/0 is missing"):
        Store.open(path)


def test_a_store_without_the_folder_of_a_field_is_damaged_and_not_continued(path):
    shutil.rmtree(path / "pressure")
    with pytest.raises(StoreError, match="is damaged: the folder of its array 'pressure' is missing; .*repeats the run"):
        Store.write(path)


def test_a_field_is_checked_too(path):
    noisy = shot(3)
    noisy.fields["film"] = np.random.default_rng(2).random((33, 9))  # does not compress: a flipped bit is another number
    with Store.write(path) as saved:
        saved.append(noisy)
    file = path / "film" / "c.3.0.0"
    whole = bytearray(file.read_bytes())
    whole[len(whole) // 2] ^= 4
    file.write_bytes(whole)
    saved = Store.open(path)
    assert saved.fields(0)["film"][0, 0] == 1.5
    with pytest.raises(StoreError, match="film/c.3.0.0 is damaged"):
        saved.fields(3)
    (path / "x" / "c" / "0").write_bytes(b"nonsense")
    with pytest.raises(StoreError, match="x/c/0 is damaged"):
        saved.x  # noqa: B018


def test_other_readers_check_it_as_well(path):
    xarray = pytest.importorskip("xarray")
    assert xarray.open_zarr(path).film[1, 0, 0] == 2.5
    file = path / "film" / "c.1.0.0"
    whole = bytearray(file.read_bytes())
    whole[-1] ^= 1
    file.write_bytes(whole)
    with pytest.raises(RuntimeError):
        xarray.open_zarr(path).film.values  # noqa: B018


class Trap:
    """Unpickling this would leave a file."""

    def __init__(self, target):
        self.target = target

    def __reduce__(self):
        return open, (str(self.target), "w")


def test_a_broken_or_pickled_checkpoint_is_refused(path, tmp_path):
    file = next((path / ".checkpoints").glob("*.npz"))
    good = file.read_bytes()
    trap = np.empty(1, object)
    trap[0] = Trap(tmp_path / "sprung")
    for spoil in (lambda: file.write_bytes(b"no zip"), lambda: file.write_bytes(pickle.dumps(trap[0])),
                  lambda: np.savez(file, P=trap, step=1, H0=0.0), lambda: file.write_bytes(good[: len(good) // 2]),
                  lambda: file.write_bytes(good.replace(good[300:320], b"x" * 20, 1)), lambda: np.savez(file, step=2),
                  lambda: np.savez(file, P=np.zeros((3, 3)), step=2, H0=0.0)):
        spoil()
        with Store.write(path) as saved, pytest.raises(StoreError, match=r"checkpoint .*3\.npz is damaged.* --out NEW"):
            saved.go_back()
    assert not (tmp_path / "sprung").exists() and len(Store.open(path)) == 3
    np.savez(file, P=np.zeros((9, 33)), step=1, H0=0.0)
    with Store.write(path) as saved, pytest.raises(StoreError, match="checkpoint is of another step"):
        saved.go_back()
    file.unlink()
    with Store.write(path) as saved, pytest.raises(StoreError, match="no checkpoint.*--out NEW"):
        saved.go_back()


@pytest.mark.parametrize("changes", [{"version": "0.0.9"}, {"format": None}, {"version": None}])
def test_a_store_of_another_version_is_shown_but_not_gone_on_with(path, changes):
    edit(path, **changes)
    with pytest.raises(StoreError, match="written by version .*--out NEW"):
        Store.write(path)
    assert not (path / ".lock").exists()
    if "format" not in changes:  # without it the series are read as version 0.1 wrote them
        assert "written by version" in Store.open(path).other_version


@pytest.mark.parametrize("version, newer", [("999.1", True), ("999.1.dev3+g0", True), (__version__, False), ("0.0.9", False),
                                            (f"{__version__}.0", False), (None, False), (7, False)])
def test_what_a_newer_version_wrote_is_not_called_damaged(path, version, newer):
    unknown = SMALL.to_dict()
    unknown["grid"]["knots"] = 3
    said = f"a.zarr was written by version {re.escape(str(version))}, this is {__version__}: install .* or newer$"
    for changes in ({"scene": json.dumps(unknown)}, {"scene": json.dumps(SMALL.to_dict()), "steps": "many"}):
        edit(path, version=version, **changes)
        with pytest.raises(StoreError, match=said if newer else "damaged"):
            Store.open(path)
    edit(path, steps=3)
    assert len(Store.open(path)) == 3  # what this one can read is read


@pytest.mark.parametrize("layout, said", [
    (99, r"was written by version .* \(layout 99\), this is .* \(layout 3\); allowed: layouts 1 to 3. Install the version"),
    (0, "'format', its layout, is 0; allowed: 1 to 3"), ("3", "is '3'; allowed"), (True, "is True; allowed"),
    (2.5, "is 2.5; allowed"), ([3], r"is \[3\]; allowed")])
def test_an_unknown_layout_is_refused(path, layout, said):
    edit(path, format=layout)
    for opened in (Store.open, Store.write):
        with pytest.raises(StoreError, match=said):
            opened(path)
    assert find(path) == SMALL  # of which a new run can be made


def test_zero_steps_meant_all_in_stores_of_version_0_1(path):
    from tehl_taichi.store import integrity

    old = json.dumps(SMALL.replace(**{"time.steps": 0}).to_dict())
    assert integrity.scene_of(path, {"scene": old}).time.steps == -1
    assert integrity.scene_of(path, {"scene": old, "format": 2}).time.steps == 0


def test_what_going_on_needs_is_asked_for_in_a_sentence(path):
    edit(path, runtime=None, steady_error="nonsense", warnings="{}", summary="[]")
    saved = Store.open(path)
    for name in ("runtime", "steady_error"):
        with pytest.raises(StoreError, match=f"attribute '{name}'.*--out NEW"):
            saved.needed(name)
    assert saved.warnings == [] and saved.summary == {}


def test_a_moved_store_is_found_at_its_new_place(path, tmp_path):
    with Store.write(path) as saved:
        saved.finish({"store": str(path), "steps": 2})
    path.rename(tmp_path / "moved.zarr")
    shutil.copytree(tmp_path / "moved.zarr", tmp_path / "copy.zarr")
    for name in ("moved.zarr", "copy.zarr"):
        with Store.write(tmp_path / name) as again:
            assert again.summary["store"] == str(tmp_path / name) and again.go_back()["step"] == 2
            again.append(shot(3))
    with pytest.raises(StoreError, match="the folder does not exist"):
        Store.open(path)


def test_a_store_that_is_moved_while_it_is_written(path, tmp_path):
    with Store.write(path) as saved:
        path.rename(tmp_path / "moved.zarr")
        with pytest.raises(StoreError, match="still being written"):
            Store.write(tmp_path / "moved.zarr")
        with pytest.raises(Interrupted, match="it was moved or removed; 3 entries are stored"):
            saved.append(shot(3))
        assert not path.exists()  # no half of a store comes up at the old name
    with Store.write(tmp_path / "moved.zarr") as again:
        assert len(again) == 3 and again.go_back()["step"] == 2
        again.append(shot(3))


@pytest.mark.parametrize("fails", ["pressure", "h_min_m", "npz", "zarr.json"])
def test_a_disk_that_fills_up_loses_no_entry(path, monkeypatch, fails):
    written = files.write

    def full(target, content):
        if fails in str(target.relative_to(path)):
            written(target, bytes(content)[:10])
            raise OSError(28, "No space left on device")
        written(target, content)

    def half(file, **arrays):
        file.write(b"half of a checkpoint")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("tehl_taichi.disk.files.write", full)
    if fails == "npz":
        monkeypatch.setattr(np, "savez", half)
    with Store.write(path) as saved:
        with pytest.raises(Interrupted, match="No space left on device; 3 entries are stored; then use: tehl resume") as told:
            saved.append(shot(3), shot(3).state)
        assert told.value.exit_code == INTERRUPTED
    monkeypatch.undo()
    with Store.write(path) as saved:
        assert len(saved) == 3 and saved.go_back()["step"] == 2
        saved.append(shot(3), shot(3).state)
    assert Store.open(path).scalar("p_max_Pa").tolist() == [0.25, 1.25, 2.25, 3.25]


def test_a_disk_that_is_full_at_the_end(path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("tehl_taichi.disk.files.replace", full)
    with Store.write(path) as saved, pytest.raises(Interrupted, match="every step is stored; then use: tehl resume"):
        saved.finish({"steps": 2}, {"Fi": ([[1.0]], ["i", "j"], "1", "index")})
    monkeypatch.undo()
    half = Store.open(path)
    assert not half.finished and half.map("Fi") is None
    with Store.write(path) as saved:
        saved.finish({"steps": 2}, {"Fi": ([[2.0]], ["i", "j"], "1", "index")})
    assert Store.open(path).map("Fi") == 2.0


def test_a_disk_that_is_full_when_a_run_goes_on(path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    with Store.write(path) as saved:
        saved.append(shot(3))
        monkeypatch.setattr("tehl_taichi.disk.files.replace", full)
        for change in (saved.go_back, lambda: saved.extend(SMALL)):
            with pytest.raises(Interrupted, match="No space left on device; then use: tehl resume"):
                change()
    monkeypatch.undo()
    assert len(Store.open(path)) == 4
    monkeypatch.setattr("tehl_taichi.disk.locks.json.dump", full)
    with pytest.raises(StoreError, match="cannot write to .*No space left on device"):
        Store.write(path)


def test_a_file_that_cannot_be_replaced_stays(tmp_path, monkeypatch):
    file = tmp_path / "f"
    files.replace(file, b"before")

    written = files.write

    def half(path, content):
        written(path, content[:2])
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("tehl_taichi.disk.files.write", half)
    with pytest.raises(OSError):
        files.replace(file, b"after")
    assert file.read_bytes() == b"before" and [p.name for p in tmp_path.iterdir()] == ["f"]


def test_going_on_behind_the_end_takes_the_results_back(path):
    with Store.write(path) as saved:
        saved.finish({"steps": 2}, {"Fi": ([[1.0]], ["i", "j"], "1", "index")})
        saved.extend(saved.scene.replace(**{"time.steps": 5}))
        assert not saved.finished and saved.summary == {} and saved.map("Fi") is None and saved.scene.time.steps == 5
        saved.append(shot(3), shot(3).state)
    again = Store.open(path)
    assert not again.finished and again.scene.time.steps == 5 and len(again) == 4 and "Fi" not in again.metadata


def test_every_scalar_says_how_it_tells_of_steps_left_out():
    from tehl_taichi.runs.recorder import Thinned

    assert {scalar.over for scalar in entries(Scalar).values()} == Thinned.METHODS.keys()


def test_thinned_entries_speak_for_the_steps_between():
    from types import SimpleNamespace

    from tehl_taichi.march.snapshot import Snapshot
    from tehl_taichi.runs.recorder import Thinned

    def of(step, value):
        scalars = {name: value for name in entries(Scalar)}
        return Snapshot(step, 0.0, 0.0, None, None, {}, scalars, lambda: {"step": step})

    thinned = Thinned(3, 8)
    values = {1: 5.0, 2: 9.0, 3: 4.0, 4: 1.0, 5: 2.0, 6: 3.0, 7: 8.0, 8: 6.0}
    kept = {step: shot for step, value in values.items() if (shot := thinned.of(of(step, value)))}
    assert list(kept) == [3, 6, 8] and kept[6].state == {"step": 6}
    notify = {name: [kept[step].scalars[name] for step in kept]
            for name in ("p_max_Pa", "h_min_m", "cycles", "friction_coefficient", "h0_m")}
    assert notify == {"p_max_Pa": [9, 3, 8], "h_min_m": [4, 1, 6], "cycles": [18, 6, 14], "friction_coefficient": [6, 2, 7],
                    "h0_m": [4, 3, 6]}
    assert SimpleNamespace(**notify).p_max_Pa[0] == 9


def test_methods_are_named_in_the_store(tmp_path):
    import zarr

    for every, said in ((1, {}), (2, {"cell_methods": "time: maximum"})):
        made = store(tmp_path / f"{every}.zarr", description=SMALL.replace(**{"output.every": every}))
        attrs = dict(zarr.open_group(str(made.path), mode="r")["p_max_Pa"].attrs)
        assert attrs == {"units": "Pa", "long_name": "largest pressure", **said}


def test_json_has_no_nan():
    from tehl_taichi.store.json_values import plain

    value = {"a": [np.float64("nan"), 1.5, (np.inf, np.int64(3))], "b": {"c": np.array([1.0, np.nan])}, "d": None, "e": "nan"}
    assert json.loads(json.dumps(plain(value), allow_nan=False)) == {
        "a": [None, 1.5, [None, 3]], "b": {"c": [1.0, None]}, "d": None, "e": "nan"}


def test_cut_passages_are_judged():
    from tehl_taichi.scene import timeline

    gear = scene("gear")
    assert timeline.total_steps(gear) == 192 and timeline.cut_at(gear) is None and gear.warnings() == []
    for changes, at in (({"time.steps": 30}, -1.6 + 30 / 64), ({"time.x_end": 0.3}, 0.3), ({"time.steps": 0}, -1.6)):
        cut = gear.replace(**changes)
        assert timeline.cut_at(cut) == pytest.approx(at, abs=1 / 64)
        said = [f"passage cut at {timeline.cut_at(cut):.2f} a" in text and "1.40 a" in text for text in cut.warnings()]
        assert said == ([True] if cut.time.steps else [])  # nobody wants steps where there are none
        assert any(line.startswith("rest of the passage") for line in cut.left_out())
        assert timeline.whole_passage(cut) == gear
    assert timeline.cut_at(gear.replace(**{"time.steps": 191})) is None  # behind the contact: 1.38 a
    assert timeline.cut_at(gear.replace(**{"time.steady_only": True})) is None
    assert timeline.remaining_scene(gear, 192) is None
    assert timeline.remaining_scene(gear.replace(**{"time.steps": 30}), 30, 12).time.steps == 42
    assert timeline.remaining_scene(gear.replace(**{"time.steps": 30}), 30, 500) == gear
    assert "0.031 a between" in gear.replace(**{"output.every": 2}).warnings()[0]
