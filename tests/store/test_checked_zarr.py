"""Datasets whose files are checked when they are read, by this process or by another one."""

import pickle
from pathlib import Path

import numpy as np
import pytest
from small_stores import shot, store

from tehl_taichi.errors import StoreError
from tehl_taichi.store import integrity
from tehl_taichi.store.store import Store

checked_zarr = pytest.importorskip("tehl_taichi.store.checked_zarr", reason="xarray")


@pytest.fixture
def path(tmp_path):
    return store(tmp_path / "a.zarr").path


def opened(path, **options):
    return checked_zarr.opened(path, *integrity.root_of(path), **options)


@pytest.mark.parametrize("options", [{}, {"chunks": None}])
def test_a_sound_store_is_what_xarray_opens(path, options):
    import xarray

    found, plain = opened(path, **options), xarray.open_zarr(path, **options)
    assert found.identical(plain) and found.film.chunks == plain.film.chunks
    assert found.encoding["source"] == plain.encoding["source"] == str(path)
    assert pickle.loads(pickle.dumps(found)).identical(plain)


def halves(file):
    file.write_bytes(file.read_bytes()[:-9])


def flips(file):
    file.write_bytes(file.read_bytes()[:-1] + bytes([file.read_bytes()[-1] ^ 1]))


def empties(file):
    file.write_bytes(b"")


def swaps(file):
    file.write_bytes((file.parent.parent / "x" / "c" / "0").read_bytes())


@pytest.mark.parametrize("damage, said", [(halves, "is damaged .its content does not fit its checksum"),
                                          (flips, "is damaged .its content does not fit its checksum"),
                                          (empties, "is damaged .it does not begin as a chunk"), (Path.unlink, "is missing"),
                                          (swaps, "is damaged .it declares 264 bytes, not the 1188 of its array")])
@pytest.mark.parametrize("options", [{}, {"chunks": None}])
def test_damage_after_opening_is_named_when_it_is_read(path, damage, said, options):
    data = opened(path, **options)
    damage(path / "film" / "c.1.0.0")
    assert data.film[2, 0, 0] == 3.5 and float(data.p_max_Pa[1]) == 1.25
    with pytest.raises(StoreError, match=rf"film/c\.1\.0\.0 {said}"):
        data.film.load()


def test_a_store_that_is_written_anew_is_another_one_for_dask(path):
    names = [opened(path).film.data.name, opened(path).film.data.name]
    with Store.write(path) as saved:
        saved.append(shot(3))
    assert names[0] == names[1] != opened(path).film.data.name and np.array_equal(opened(path).film[3, 0, 0], 4.5)
