"""Arrays that are written without zarr are those that zarr would write, and are read as it reads them."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import zarr

from tehl_taichi.errors import StoreError
from tehl_taichi.store import array_file, chunks

ATTRIBUTES = {"units": "1", "long_name": "what", "flag_values": [0, 1]}


def by_zarr(shape, chunk, dtype, dims, fill, between):
    made = {}
    zarr.create_array(made, shape=shape, chunks=chunk, dtype=dtype, dimension_names=dims, fill_value=fill,
                      compressors=zarr.codecs.ZstdCodec(level=chunks.LEVEL, checksum=True), attributes=ATTRIBUTES,
                      chunk_key_encoding={"name": "default", "separator": between})
    return made["zarr.json"].to_bytes()


@pytest.mark.parametrize("dtype, fill", [("f4", math.nan), ("f8", math.nan), ("f8", 0.0), ("i8", -1), ("u1", 0), ("i1", 0),
                                         ("i4", 0)])
@pytest.mark.parametrize("shape, chunk, dims, between", [((7,), (7,), ["time"], "/"),
                                                         ((7, 3, 2), (1, 3, 2), ["time", "x", "y"], ".")])
def test_descriptions_are_those_of_zarr(dtype, fill, shape, chunk, dims, between):
    own = array_file.content(array_file.described(shape, chunk, dtype, dims, fill, ATTRIBUTES, between))
    assert own == by_zarr(shape, chunk, dtype, dims, fill, between)


def folder_of(path, values, **changes):
    path.mkdir()
    found = array_file.described(values.shape, values.shape, values.dtype, ["a", "b"], 0, ATTRIBUTES) | changes
    (path / "zarr.json").write_bytes(array_file.content(found))
    array_file.write_values(path, values)
    return path


@pytest.mark.parametrize("dtype", ["f4", "f8", "i4", "i1"])
def test_zarr_reads_what_is_written_and_the_other_way_round(tmp_path, dtype, monkeypatch):
    values = np.arange(12).reshape(3, 4).astype(dtype)
    path = folder_of(tmp_path / "a", values)
    for more in (0, 1):
        array_file.write_values(path, values + more)
        theirs = zarr.open_array(str(path), mode="r")
        assert np.array_equal(theirs[...], values + more) and theirs.dtype == values.dtype
        assert dict(theirs.attrs) == ATTRIBUTES
    monkeypatch.setattr(array_file, "_by_zarr", None)
    found = array_file.read_whole(path)
    assert np.array_equal(found, values + 1) and found.dtype == values.dtype and found.flags.writeable


@pytest.mark.parametrize("make", [
    lambda root: root.create_array("a", shape=(6, 5), chunks=(4, 5), dtype="f8"),
    lambda root: root.create_array("a", shape=(6, 5), chunks=(6, 5), dtype="f8", chunk_key_encoding={"name": "default",
                                                                                                     "separator": "."}),
    lambda root: root.create_array("a", shape=(6, 5), chunks=(6, 5), dtype="f8", compressors=None)])
def test_arrays_of_other_writers_are_read_by_zarr(tmp_path, make):
    values = np.arange(30.0).reshape(6, 5)
    make(zarr.open_group(str(tmp_path), mode="w"))[...] = values
    assert np.array_equal(array_file.read_whole(tmp_path / "a"), values)


def test_text_and_unwritten_values_are_read_by_zarr(tmp_path):
    root = zarr.open_group(str(tmp_path), mode="w")
    root.create_array("words", shape=(2,), chunks=(2,), dtype=str)[...] = np.array(["a", "bc"], dtype=object)
    root.create_array("none", shape=(2,), chunks=(2,), dtype="f8", fill_value=7.0,
                      compressors=zarr.codecs.ZstdCodec(level=chunks.LEVEL, checksum=True))
    assert list(array_file.read_whole(tmp_path / "words")) == ["a", "bc"]
    assert list(array_file.read_whole(tmp_path / "none")) == [7.0, 7.0]


def test_damage_is_reported(tmp_path):
    path = folder_of(tmp_path / "a", np.ones((2, 3)))
    file = array_file.chunk_file(path, 2)
    file.write_bytes(file.read_bytes()[:-3])
    with pytest.raises(StoreError, match="is damaged"):
        array_file.read_whole(path)
    array = json.loads((path / "zarr.json").read_text())
    del array["shape"]
    (path / "zarr.json").write_text(json.dumps(array))
    with pytest.raises(StoreError, match="is damaged or missing .its zarr.json has no 'shape'"):
        array_file.read_whole(path)


@pytest.mark.parametrize("values", [np.arange(6.0).reshape(2, 3), np.array([[1, 2]], "i8"),
                                    np.array(["a", "bc"], dtype=object)])
def test_a_whole_array_replaces_an_earlier_one(tmp_path, values):
    dims, attributes = ["one", "two"][: values.ndim], {"units": "1"}
    for _ in range(2):
        found = array_file.write(tmp_path / "a", values, dims, 0, attributes)
        assert found == json.loads((tmp_path / "a" / "zarr.json").read_text())
        there = zarr.open_array(str(tmp_path / "a"), mode="r")
        assert np.array_equal(there[...], values) and list(there.metadata.dimension_names) == dims
        assert dict(there.attrs) == attributes
        values = values[::-1].copy()


def test_a_store_is_written_and_read_without_zarr(tmp_path):
    """Loading it takes 0.1 s."""
    code = f"""import sys
sys.path.insert(0, {str(Path(__file__).parents[1])!r})
import numpy as np
from small_stores import store
from tehl_taichi.runs import single_run
from tehl_taichi.store.store import Store
with Store.write(store({str(tmp_path / "a.zarr")!r}).path) as saved:
    saved.finish({{"warnings": []}}, {{"fi": (np.ones((2, 3)), ["x", "y"], "1", "index")}})
found = Store.open(saved.path)
print(found.x.size, found.map("fi").sum(), "zarr" in sys.modules)"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["33", "6.0", "False"]
