"""Names of stores: reserved, locked, published whole, replaced by renames; what kills leave is recognised."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from small_stores import SMALL, shot, store

from tehl_taichi.disk import drafts as places
from tehl_taichi.disk.drafts import clean, staging_path
from tehl_taichi.disk.locks import LOCK, Busy, Lock, holder, is_abandoned
from tehl_taichi.errors import Error, StoreError
from tehl_taichi.store.store import Store
from tehl_taichi.store.store_draft import StoreDraft


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def killed_holder(folder):
    """A lock left by a process that was killed while it held it."""
    code = ("import os, signal, sys; from tehl_taichi.disk.locks import Lock; lock = Lock(sys.argv[1]); "
            "os.kill(os.getpid(), signal.SIGKILL)")
    assert subprocess.run([sys.executable, "-c", code, folder]).returncode == -9
    return folder


def test_one_writer_at_a_time_and_its_name(tmp_path):
    saved = store(tmp_path / "a.zarr")
    with Store.write(saved.path) as one:
        assert one.writer.startswith(f"process {os.getpid()} on ")
        with pytest.raises(Busy, match=rf"a.zarr is still being written by process {os.getpid()} on .* \(since 2"):
            Store.write(saved.path)
        with pytest.raises(Busy, match="still being written"):
            StoreDraft(saved.path, replace=True)
        assert len(Store.open(saved.path)) == 3  # readers are never kept out
    assert Store.open(saved.path).writer is None and LOCK not in names(saved.path)
    Store.write(saved.path).close()


def test_a_lock_of_a_dead_process_is_taken_over_silently(tmp_path):
    saved = store(tmp_path / "a.zarr")
    killed_holder(saved.path)
    assert is_abandoned(saved.path) and holder(saved.path) is None
    with Store.write(saved.path) as again:
        assert json.loads((again.path / LOCK).read_text())["pid"] == os.getpid()


def test_a_lock_of_another_host_says_how_to_clear_it(tmp_path):
    saved = store(tmp_path / "a.zarr")
    said = {"program": "tehl_taichi", "pid": 7, "host": "elsewhere", "since": 0.0}
    (saved.path / LOCK).write_text(json.dumps(said))
    with pytest.raises(Busy, match=r"process 7 on elsewhere.*remove .*a.zarr/\.lock"):
        Store.write(saved.path)
    (saved.path / LOCK).unlink()
    Store.write(saved.path).close()


def test_where_the_kernel_has_no_locks_the_process_tells(tmp_path, monkeypatch):
    import fcntl

    def none(*_):
        raise OSError(37, "No locks available")

    monkeypatch.setattr(fcntl, "flock", none)
    lock = Lock(tmp_path)
    with pytest.raises(Busy):
        Lock(tmp_path)
    lock.file.close()
    gone = subprocess.run([sys.executable, "-c", "import os; print(os.getpid())"], capture_output=True, text=True).stdout
    (tmp_path / LOCK).write_text((tmp_path / LOCK).read_text().replace(f'"pid": {os.getpid()}', f'"pid": {int(gone)}'))
    Lock(tmp_path).release()


def test_two_at_once_get_two_names_from_the_start(tmp_path):
    with StoreDraft.fresh(tmp_path / "runs", "gear") as one, StoreDraft.fresh(tmp_path / "runs", "gear") as other:
        assert (one.path.name, other.path.name) == ("gear-1.zarr", "gear-2.zarr")
        with pytest.raises(Busy, match="gear-1.zarr is still being written by process"):
            StoreDraft(one.path)
        with pytest.raises(StoreError, match="gear-1.zarr is still being written by process"):
            Store.open(one.path)
        assert not one.path.exists()
    assert names(tmp_path) == []  # given up: nothing is left, nor the folder that was made for them


def test_a_store_appears_with_its_first_entry(tmp_path, monkeypatch):
    path, seen = tmp_path / "a.zarr", []
    append = Store._append
    monkeypatch.setattr(Store, "_append", lambda *words, **more: (seen.append(path.exists()), append(*words, **more)))
    store(path, entries=1)
    assert seen == [False] and names(tmp_path) == ["a.zarr"] and len(Store.open(path)) == 1


def test_a_failed_first_entry_leaves_nothing(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("tehl_taichi.disk.files.replace", full)
    with pytest.raises(Error, match="No space left on device; nothing is stored"):
        store(tmp_path / "runs" / "a.zarr")
    assert names(tmp_path) == []


def test_what_a_kill_left_is_named_and_cleaned(tmp_path):
    left, path = killed_holder(made(staging_path(tmp_path / "a.zarr", "part"))), tmp_path / "a.zarr"
    (left / "x").mkdir()
    with pytest.raises(StoreError, match="its run ended before the first entry"):
        Store.open(path)
    with StoreDraft(path):
        assert names(left) == [LOCK]
    killed_holder(made(left))
    store(tmp_path / "b.zarr")
    assert names(tmp_path) == ["b.zarr"]


def made(folder):
    folder.mkdir(exist_ok=True)
    return folder


def test_only_what_is_abandoned_is_cleaned(tmp_path):
    with StoreDraft(tmp_path / "a.zarr"):
        (tmp_path / ".notes.part").mkdir()
        (tmp_path / ".notes.part" / "thesis.txt").touch()
        clean(tmp_path)
        assert names(tmp_path) == [".a.zarr.part", ".notes.part"] and (tmp_path / ".notes.part" / "thesis.txt").exists()


def test_force_replaces_a_store_only_when_the_new_one_stands(tmp_path):
    path = store(tmp_path / "a.zarr", entries=3).path
    with pytest.raises(StoreError, match="exists already.*force=True"):
        StoreDraft(path)
    with StoreDraft(path, replace=True):
        assert len(Store.open(path)) == 3
    assert len(Store.open(path)) == 3 and names(tmp_path) == ["a.zarr"] and LOCK not in names(path)
    with StoreDraft(path, replace=True) as place, Store.create(place, SMALL, shot(0), 5) as new:
        assert len(Store.open(path)) == len(new) == 1
    assert names(tmp_path) == ["a.zarr"]


@pytest.mark.parametrize("content, said", [
    ({"zarr.json": "{}", "thesis.txt": "all of it"}, "is not a store of tehl run"),
    ({"zarr.json": '{"attributes": {"scene": "no steps"}}'}, "is not a store of tehl run"),
    ({"data.csv": "1"}, "is not a store of tehl run")])
def test_force_replaces_nothing_but_stores(tmp_path, content, said):
    folder = made(tmp_path / "d")
    for name, text in content.items():
        (folder / name).write_text(text)
    for replace in (True, False):
        with pytest.raises(StoreError, match=said if replace else "exists already and is not a store"):
            StoreDraft(folder, replace)
    assert {name: (folder / name).read_text() for name in names(folder)} == content


def test_a_stranger_in_a_store_is_not_deleted(tmp_path):
    path = store(tmp_path / "a.zarr").path
    (path / "thesis.txt").touch()
    with pytest.raises(StoreError, match="holds thesis.txt, which is not part of a store"):
        StoreDraft(path, replace=True)


class Killed(BaseException):
    pass


@pytest.fixture
def killed_before(monkeypatch):
    """Lets os.rename end the process, so to say, at a folder of that ending."""
    rename = os.rename

    def prepare(ending):
        def at(source, target):
            if Path(source).name.endswith(ending):
                raise Killed
            rename(source, target)

        monkeypatch.setattr(places.os, "rename", at)

    return prepare


def replace_until_killed(path):
    with pytest.raises(Killed):
        Store.create(StoreDraft(path, replace=True), SMALL, shot(0), 5)


def test_a_kill_between_the_two_renames_loses_nothing(tmp_path, monkeypatch, killed_before):
    path = store(tmp_path / "a.zarr", entries=3).path
    with monkeypatch.context() as inside:
        inside.setattr(StoreDraft, "give_up", lambda self: None)
        killed_before(".part")
        replace_until_killed(path)
    monkeypatch.undo()
    assert names(tmp_path) == [".a.zarr.old", ".a.zarr.part"]
    assert len(Store.open(path)) == 3 and names(tmp_path) == [".a.zarr.part", "a.zarr"]


def test_ctrl_c_between_the_two_renames_loses_nothing(tmp_path, killed_before):
    path = store(tmp_path / "a.zarr", entries=3).path
    killed_before(".part")
    replace_until_killed(path)
    assert names(tmp_path) == ["a.zarr"] and len(Store.open(path)) == 3


def test_a_kill_after_the_two_renames_leaves_the_new_store(tmp_path, monkeypatch, killed_before):
    path = store(tmp_path / "a.zarr", entries=3).path
    killed_before(".old")
    replace_until_killed(path)
    monkeypatch.undo()
    assert names(tmp_path) == [".a.zarr.old", "a.zarr"] and len(Store.open(path)) == 1
    killed_holder(tmp_path / ".a.zarr.old")
    (tmp_path / "a.zarr").rename(tmp_path / "c.zarr")
    clean(tmp_path)
    assert names(tmp_path) == [".a.zarr.old", "c.zarr"]  # the only one of its name stays
    (tmp_path / "c.zarr").rename(path)
    clean(tmp_path)
    assert names(tmp_path) == ["a.zarr"] and len(Store.open(path)) == 1


def test_half_removed_stores_are_cleaned_not_put_back(tmp_path):
    gone = made(staging_path(tmp_path / "a.zarr", "gone"))
    (gone / "pressure").mkdir()
    killed_holder(gone)
    with pytest.raises(StoreError, match="not a store"):
        Store.open(tmp_path / "a.zarr")
    store(tmp_path / "b.zarr")
    assert names(tmp_path) == ["b.zarr"]


@pytest.mark.parametrize("out, said", [
    ("dangling", "broken link"), ("loop", "broken link"), ("loop/a.zarr", "not a folder"),
    ("file/a.zarr", "not a folder"), ("file", "is not a store"), (".", "not a possible name"), ("a" * 300, "too long")])
def test_places_where_no_store_can_be_made(tmp_path, out, said):
    (tmp_path / "dangling").symlink_to("nothing")
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "file").touch()
    before = names(tmp_path)
    with pytest.raises(StoreError, match=said):
        StoreDraft(Path(".") if out == "." else tmp_path / out)
    assert names(tmp_path) == before


@pytest.mark.parametrize("left, replaced", [((), True), (("zarr.0a1b.partial",), True), (("notes.txt",), False),
                                            (("zarr.0a1b.partial", "notes.txt"), False)])
def test_an_array_that_was_only_begun_is_part_of_a_store(tmp_path, left, replaced):
    """A process that is killed while it writes its results leaves a folder without metadata."""
    path = store(tmp_path / "a.zarr").path
    (path / "Fi").mkdir()
    for name in left:
        (path / "Fi" / name).touch()
    if replaced:
        with StoreDraft(path, replace=True) as place:
            place.give_up()
    else:
        with pytest.raises(StoreError, match="holds Fi, which is not part of a store"):
            StoreDraft(path, replace=True)
    assert len(Store.open(path)) == 3


def test_a_link_to_a_store_is_not_replaced(tmp_path):
    path = store(tmp_path / "a.zarr").path
    (tmp_path / "link").symlink_to(path)
    with pytest.raises(StoreError, match="is a link"):
        StoreDraft(tmp_path / "link", replace=True)
    assert len(Store.open(tmp_path / "link")) == 3


WRITER = """
import itertools, sys
from small_stores import SMALL, shot
from tehl_taichi.store.store_draft import StoreDraft as Place
from tehl_taichi.store.store import Store
print(flush=True)
for _ in itertools.count():
    with Place(sys.argv[1], replace=True) as place, Store.create(place, SMALL, shot(0), 50) as made:
        for step in range(1, 8):
            made.append(shot(step), shot(step).state if step % 3 == 0 else None)
        made.finish({"steps": 7}, {"m": ([1.0, 2.0], ["i"], "1", "a map")})
"""


def killed_writer(path, moment):
    """A process that makes and replaces the store at `path` without end, killed at that moment (s)."""
    process = subprocess.Popen([sys.executable, "-c", WRITER, path], stdout=subprocess.PIPE,
                               env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[1])})
    process.stdout.readline()
    try:
        process.wait(moment)
    except subprocess.TimeoutExpired:
        process.kill()
    assert process.wait() == -9


def assert_whole(path):
    """Nothing there yet, or a store whose entries are what their steps say, and which can be gone on with."""
    try:
        with Store.write(path) as saved:
            for n in range(len(saved)):
                assert saved.series["step"][n] == n and saved.scalar("h0_m")[n] == n + 0.25
                assert all((field == field.dtype.type(n + 1.5)).all() for field in saved.fields(n).values())
            assert saved.go_back()["step"] == len(saved) - 1
            assert not saved.finished or (saved.summary["steps"], *saved.map("m")) == (7, 1.0, 2.0)
    except StoreError as error:
        assert "its run ended before the first entry" in str(error) or "the folder does not exist" in str(error)
        return False
    return True


def kill_loop(path, kills):
    import random

    draw, whole = random.Random(7), 0
    for _ in range(kills):
        killed_writer(path, draw.uniform(0.0, 1.5))
        whole += assert_whole(path)
    store(path.with_name("after.zarr"))
    assert [name for name in names(path.parent) if name.startswith(".")] == []
    return whole


def test_kills_at_any_moment_leave_a_whole_store_or_none(tmp_path):
    assert kill_loop(tmp_path / "a.zarr", 3) >= 1


@pytest.mark.slow
def test_sixty_kills(tmp_path):
    assert kill_loop(tmp_path / "a.zarr", 60) > 40
