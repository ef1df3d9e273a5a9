"""Received stores, studies and flanks whose files are links to files outside: nothing outside changes, nothing is lost."""

import json
import os
import shutil
import stat
from pathlib import Path

import fake_cases
import made_results
import pytest
from small_stores import SMALL, shot, store

import tehl_taichi as tehl
from tehl_taichi.disk.drafts import staging_path
from tehl_taichi.errors import StoreError
from tehl_taichi.runs.flank import flank
from tehl_taichi.runs.flank.stored_flank import Flank
from tehl_taichi.runs.sweep import sweeping
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.runs.sweep.study_table import Study
from tehl_taichi.store.store import Store
from tehl_taichi.store.store_draft import StoreDraft

TWO = plan(SMALL, {"feature.height": [0.5e-6, 0.6e-6]})


def cli(*words):
    """(exit code, what it says) of the command."""
    from tehl_cli.main import app
    from typer.testing import CliRunner

    found = CliRunner().invoke(app, [*map(str, words)])
    return getattr(found.exception, "exit_code", found.exit_code), f"{found.output}{found.exception or ''}"


def snapshot(folder):
    """{path: what tells it from any other file or state of it} of everything below a folder, links as such."""
    found = {path: os.lstat(path) for path in (str(folder), *_below(str(folder)))}
    return {path: (s.st_mode, s.st_ino, s.st_nlink, s.st_size, stat.S_ISREG(s.st_mode) and s.st_mtime_ns)
            for path, s in found.items()}


def _below(folder):
    with os.scandir(folder) as entries:
        for entry in entries:
            yield entry.path
            if entry.is_dir(follow_symlinks=False):
                yield from _below(entry.path)


def swept(path, count=2):
    """A study of so many cases, with a store of each and some left to do."""
    heights = [0.5e-6 + 0.1e-6 * n for n in range(count)]
    with pytest.raises(KeyboardInterrupt):
        sweeping.run(plan(SMALL, {"feature.height": heights}), path, workers=1, work=_stopped_after(1))
    store(path / "cases" / "0000.zarr", 1)
    return path


def _stopped_after(count):
    done = []

    def work(job):
        if len(done) == count:
            raise KeyboardInterrupt
        done.append(job)
        return fake_cases.formula(job)

    return work


def stored(path):
    found = store(path, 1).path
    (found / ".lock").write_text(json.dumps({"program": "tehl_taichi", "pid": 2**22 + 1, "host": os.uname().nodename}))
    return found


def flanked(path):
    path.mkdir()
    store(path / "1.zarr", 1)
    return made_results.flank(path)


def write_to_store(path):
    for attempt in (lambda: Store.write(path).close(), lambda: StoreDraft(path, replace=True).give_up(),
                    lambda: tehl.resume(path)):
        with pytest.raises(StoreError) as refused:
            attempt()
    return str(refused.value)


def write_to_study(path):
    with pytest.raises(StoreError) as refused:
        sweeping.run(TWO, path, workers=1, work=fake_cases.formula)
    return str(refused.value)


def write_to_flank(path):
    with pytest.raises(StoreError) as refused:
        flank("fzg-c", at=["A", "C", "E"], folder=path, workers=1)
    return str(refused.value)


# the doors that these go through, without the work before
DOORS = {"store": (lambda path: Store.write(path).close(), lambda path: StoreDraft(path, replace=True).give_up()),
         "study": (lambda path: Study.write(path, TWO).close(),), "flank": (Flank.check_writable,)}
ARCHIVES = {"store": (stored, write_to_store), "study": (swept, write_to_study), "flank": (flanked, write_to_flank)}


def by_symlink(file, outside):
    shutil.move(file, outside)
    file.symlink_to(outside)


def by_hard_link(file, outside):
    os.link(file, outside)


def by_fifo(file, outside):
    file.unlink()
    os.mkfifo(file)


@pytest.mark.parametrize("replaced", [by_symlink, by_hard_link, by_fifo])
@pytest.mark.parametrize("kind", ARCHIVES)
def test_no_file_of_an_archive_leads_writing_outside(tmp_path, kind, replaced):
    """Every file of the folder and every fourth of those below in turn, through each door. What opens no more (a FIFO in place
    of the attributes) is refused for that."""
    path, kept, outside = ARCHIVES[kind][0](tmp_path / "made"), tmp_path / "kept", tmp_path / "outside"
    files = sorted(file for file in path.rglob("*") if file.is_file())
    assert len(files) > 4
    for file in (one for n, one in enumerate(files) if one.parent == path or n % 4 == 0):
        shutil.copy2(file, kept)
        replaced(file, outside)
        before = snapshot(tmp_path)
        for door in DOORS[kind]:
            with pytest.raises(StoreError) as refused:
                door(path)
            assert str(file) in str(refused.value) or str(path) in str(refused.value) and replaced is by_fifo, refused.value
        assert snapshot(tmp_path) == before, file
        file.unlink()
        shutil.move(kept, file)
        outside.unlink(missing_ok=True)


@pytest.mark.parametrize("replaced", [by_symlink, by_hard_link, by_fifo])
@pytest.mark.parametrize("kind", ARCHIVES)
def test_whole_commands_go_through_these_doors(tmp_path, kind, replaced):
    make, write = ARCHIVES[kind]
    path = make(tmp_path / "made")
    file = next(path.rglob("wall_s/c/0" if kind == "store" else "*.csv"))
    replaced(file, tmp_path / "outside")
    before = snapshot(tmp_path)
    assert str(file) in write(path) and snapshot(tmp_path) == before


@pytest.mark.parametrize("kind", ARCHIVES)
def test_no_folder_of_an_archive_leads_writing_outside(tmp_path, kind):
    make, write = ARCHIVES[kind]
    path, outside = make(tmp_path / "made"), tmp_path / "outside"
    for folder in sorted(folder for folder in path.rglob("*") if folder.is_dir())[::2]:
        by_symlink(folder, outside)
        before = snapshot(tmp_path)
        assert str(folder) in write(path)
        assert snapshot(tmp_path) == before, folder
        folder.unlink()
        shutil.move(outside, folder)


@pytest.mark.parametrize("kind", ARCHIVES)
def test_an_archive_that_is_a_link_is_not_written(tmp_path, kind):
    make, write = ARCHIVES[kind]
    found = make(tmp_path / "source")
    (tmp_path / "link").symlink_to(found)
    before = snapshot(tmp_path)
    assert f"{tmp_path / 'link'} is a link" in write(tmp_path / "link")
    assert snapshot(tmp_path) == before


def test_a_case_behind_a_link_in_its_study_is_not_written(tmp_path):
    study, other = swept(tmp_path / "study"), tmp_path / "other"
    shutil.move(study / "cases", other)
    (study / "cases").symlink_to(other)
    before = snapshot(tmp_path)
    for attempt in (Store.write, tehl.resume, lambda path: StoreDraft(path, replace=True)):
        with pytest.raises(StoreError, match="study/cases is a link|lies in .*study"):
            attempt(study / "cases" / "0000.zarr")
    (study / "pictures").symlink_to(other)
    second = store(tmp_path / "b.zarr").path
    for out in (study / "pictures" / "a.png", study / "cases" / "a.png"):
        assert cli("compare", other / "0000.zarr", second, "--out", out)[0] == 2
    shutil.rmtree(second)
    (study / "pictures").unlink()
    assert snapshot(tmp_path).keys() == before.keys()


def test_folders_of_figures_that_came_as_links(tmp_path):
    """An archive may bring a link with the name that the figures would have."""
    pytest.importorskip("matplotlib")
    mine = thesis(tmp_path / "thesis")
    path = made_results.run(tmp_path / "a.zarr", SMALL, 3)
    (tmp_path / "a").symlink_to(mine)
    code, said = cli("plot", path, "--dpi", 40)
    assert code == 2 and f"{tmp_path / 'a'} is a link" in said and [file.name for file in mine.iterdir()] == ["chapter.tex"]
    folder = flanked(tmp_path / "flank")
    (tmp_path / "f").symlink_to(folder)
    assert cli("plot", tmp_path / "f", "--dpi", 40)[0] == 2
    (folder / "more").symlink_to(mine)
    assert cli("plot", folder, "--dpi", 40)[0] == 2 and not (folder / "flank.png").exists()


def test_attributes_nested_without_end(tmp_path):
    path = store(tmp_path / "a.zarr").path
    deep = "[" * 200_000
    (path / "zarr.json").write_text(deep)
    with pytest.raises(StoreError, match="is not a store of tehl run"):
        tehl.open(path)
    folder = flanked(tmp_path / "f")
    (folder / "flank.json").write_text(deep)
    with pytest.raises(StoreError, match="flank.json is damaged"):
        tehl.open(folder)


def thesis(folder):
    folder.mkdir()
    (folder / "chapter.tex").write_text("four years of work")
    return folder


@pytest.mark.parametrize("kind", ["link", "store", "folder", "file"])
def test_what_has_the_name_of_a_draft_stays(tmp_path, kind):
    """B1: a link, another store behind it with a stale lock, somebody's folder, a file."""
    runs, mine = tmp_path / "runs", thesis(tmp_path / "thesis")
    runs.mkdir()
    part = staging_path(runs / "gear-1.zarr", "part")
    if kind == "link":
        part.symlink_to(mine)
    elif kind == "store":
        part.symlink_to(stored(tmp_path / "other.zarr"))
    elif kind == "folder":
        thesis(part)
    else:
        part.write_text("mine")
    before = snapshot(tmp_path)
    with pytest.raises(StoreError, match=r"gear-1.zarr.part is in the way"):
        StoreDraft(runs / "gear-1.zarr")
    with StoreDraft.fresh(runs, "gear") as place:  # takes the next number
        assert place.path.name == "gear-2.zarr"
        store(runs / "another.zarr", 1)  # whose draft cleans the folder
        shutil.rmtree(runs / "another.zarr")
    assert snapshot(tmp_path) == before


@pytest.mark.parametrize("what", ["old", "gone", "part"])
def test_links_beside_a_store_are_neither_put_back_nor_cleaned(tmp_path, what):
    runs, other = tmp_path / "runs", stored(tmp_path / "other.zarr")
    runs.mkdir()
    staging_path(runs / "a.zarr", what).symlink_to(other)
    before = snapshot(tmp_path)
    with pytest.raises(StoreError):
        Store.open(runs / "a.zarr")
    store(runs / "b.zarr", 1)
    shutil.rmtree(runs / "b.zarr")
    assert snapshot(tmp_path) == before


def test_links_in_a_leftover_are_removed_not_followed(tmp_path):
    mine, left = thesis(tmp_path / "thesis"), staging_path(tmp_path / "a.zarr", "part")
    shutil.copytree(stored(tmp_path / "other.zarr"), left)
    (left / "x" / "thesis").symlink_to(mine)
    (left / "thesis").symlink_to(mine)
    os.link(mine / "chapter.tex", left / "chapter.tex")
    store(tmp_path / "b.zarr", 1)
    assert not left.exists() and (mine / "chapter.tex").read_text() == "four years of work"


def test_a_store_cannot_be_emptied_by_the_lock_of_another_program(tmp_path):
    path = store(tmp_path / "a.zarr").path
    (path / ".lock").write_text("my notes")
    with pytest.raises(StoreError, match="is not a lock of tehl"):
        Store.write(path)
    assert (path / ".lock").read_text() == "my notes"


def test_temporary_names_cannot_be_guessed_and_are_tidied(tmp_path):
    from tehl_taichi.disk import files

    names = []
    for _ in range(2):
        with files.replacement(tmp_path / "a") as temporary:
            names.append(temporary.name)
            files.write(temporary, b"1")
    assert len(set(names)) == 2 and [path.name for path in tmp_path.iterdir()] == ["a"]
    path = store(tmp_path / "a.zarr").path
    (path / names[0]).write_text("half")
    Store.write(path).close()
    assert not (path / names[0]).exists() and len(Store.open(path)) == 3


def test_a_chunk_that_is_there_is_made_anew(tmp_path):
    """Not written through: a store that went back writes its entries again."""
    path = store(tmp_path / "a.zarr").path
    with Store.write(path) as saved:
        saved.go_back()
        chunk = saved._file("pressure", 3)
        os.link(__file__, chunk) if os.stat(__file__).st_dev == os.stat(path).st_dev else chunk.symlink_to(__file__)
        before = Path(__file__).read_bytes()
        saved.append(shot(3), shot(3).state)
    assert Path(__file__).read_bytes() == before and len(Store.open(path)) == 4


def put(kind, path, target):
    {"link": lambda: path.symlink_to(target), "dangling": lambda: path.symlink_to(target.with_name("none")),
     "hard": lambda: os.link(target, path), "fifo": lambda: os.mkfifo(path), "folder": path.mkdir}[kind]()


@pytest.mark.parametrize("kind", ["link", "dangling", "hard", "fifo", "folder"])
def test_single_files_and_locks_are_written_to_plain_files_alone(tmp_path, kind):
    """Each writer by itself, without the look at the whole folder before."""
    from tehl_taichi.disk import files
    from tehl_taichi.disk.locks import Lock, holder, is_abandoned

    mine, folder = tmp_path / "thesis", tmp_path / "folder"
    mine.write_text("four years of work\n")
    folder.mkdir()
    put(kind, folder / ".lock", mine)
    before = snapshot(tmp_path)
    for attempt in (lambda: files.append(folder / ".lock", b"x"), lambda: files.truncate(folder / ".lock", 0),
                    lambda: Lock(folder)):
        with pytest.raises(OSError):
            attempt()
        assert snapshot(tmp_path) == before
    assert holder(folder) is None and not is_abandoned(folder)
    if kind != "folder":
        files.write(folder / ".lock", b"new")  # takes the name, not what has it
        assert (folder / ".lock").read_bytes() == b"new" and not (folder / ".lock").is_symlink()
    assert mine.read_text() == "four years of work\n" and not (tmp_path / "none").exists()
