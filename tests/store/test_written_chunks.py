"""Which chunk files a store must have: all that its writer has written."""

import json
import shutil

import pytest
from small_stores import store

from tehl_taichi.errors import StoreError
from tehl_taichi.store import integrity, written_chunks
from tehl_taichi.store.store import Store

MAPS = {"Fi": ([[1.0, 2.0]], ["i", "j"], "1", "index"), "none": ([float("nan")], ["i"], "1", "what is not known")}


@pytest.fixture(scope="module")
def template(tmp_path_factory):
    with Store.write(store(tmp_path_factory.mktemp("template") / "a.zarr").path) as made:
        made.finish({}, MAPS)
    return made.path


@pytest.fixture
def path(template, tmp_path):
    return shutil.copytree(template, tmp_path / "a.zarr")


def check(path):
    attrs, arrays = integrity.root_of(path)
    written_chunks.check(path, arrays, attrs)


def edit(path, change):
    root = json.loads((path / "zarr.json").read_text())
    change(root["attributes"], root["consolidated_metadata"]["metadata"])
    (path / "zarr.json").write_text(json.dumps(root))


def of_version_0_9(path):
    """The store as zarr wrote it for version 0.9.0: without chunks that hold only the fill value."""
    edit(path, lambda attrs, arrays: attrs.pop(written_chunks.EVERY))
    shutil.rmtree(path / "none" / "c")


@pytest.mark.parametrize("file", ["x/c/0", "y/c/0", "time/c/0", "film/c.0.0.0", "film/c.2.0.0", "Fi/c/0/0", "none/c/0"])
@pytest.mark.parametrize("every", [True, None])
def test_a_missing_chunk_is_named(path, file, every):
    edit(path, lambda attrs, arrays: attrs.update({written_chunks.EVERY: every}))
    check(path)
    (path / file).unlink()
    with pytest.raises(StoreError, match=f"{file} is missing: the store is damaged$"):
        check(path)


def test_a_folder_of_chunks_is_missing(path):
    for name in ("x", "Fi"):
        shutil.rmtree(path / name / "c")
        with pytest.raises(StoreError, match=f"{name}/c/0.* is missing"):
            Store.open(path).map(name)


def test_fill_values_that_version_0_9_left_out_are_read(path):
    of_version_0_9(path)
    check(path)
    saved = Store.open(path)
    assert str(saved.map("none")) == "[nan]" and saved.map("Fi").tolist() == [[1.0, 2.0]]


def test_entries_that_are_not_yet_shown_need_no_chunk(path):
    """The arrays are declared for 50 entries, and three are complete."""
    assert json.loads((path / "film" / "zarr.json").read_text())["shape"][0] == 50 and len(Store.open(path)) == 3
    (path / "film" / "c.1.0.0").unlink()
    edit(path, lambda attrs, arrays: [array["shape"].__setitem__(0, 1) for array in arrays.values()
                                      if array["dimension_names"][0] == "time"])
    check(path)


def test_chunks_of_other_writers_may_be_missing(path):
    """Also those of version 0.1, without checksums."""
    (path / "Fi" / "c" / "0" / "0").unlink()
    edit(path, lambda attrs, arrays: arrays["Fi"]["codecs"][1]["configuration"].update(checksum=False))
    check(path)


@pytest.mark.parametrize("change", [{"shape": None}, {"shape": ["3", 2]}, {"chunk_grid": {}}, {"chunk_key_encoding": []},
                                    {"shape": [1]}, {"dimension_names": None}])
def test_metadata_without_chunks_are_refused(path, change):
    edit(path, lambda attrs, arrays: (attrs.pop(written_chunks.EVERY), arrays["Fi"].update(change)))
    with pytest.raises(StoreError, match="Fi is damaged: its metadata do not describe its chunks"):
        check(path)
