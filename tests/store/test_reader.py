"""Reading of a sound store with arguments that it does not have."""

import numpy as np
import pytest
from small_stores import store

from tehl_taichi.errors import SceneError, UnknownName
from tehl_taichi.store.store import Store


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    return Store.open(store(tmp_path_factory.mktemp("reader") / "a.zarr").path)


@pytest.mark.parametrize("entry, said", [(99, "99 is out of range"), (3, "3 is out of range"), (-1, "-1 is out of range"),
                                         (1.5, "1.5 is not a whole number"), (None, "None is not a whole number"),
                                         (True, "True is not a whole number"), ("1", "'1' is not a whole number")])
def test_an_entry_that_a_sound_store_has_not(saved, entry, said):
    for read in (saved.fields, saved.feature_x, lambda n: saved.fields(n, ["film"])):
        with pytest.raises(SceneError, match=f"entry = {said}; allowed: 0 to 2$"):
            read(entry)


@pytest.mark.parametrize("name, said", [("flim", r"no array 'flim' \(did you mean '.*'\?\); known: "), (3, "no array 3; known"),
                                        (["film"], r"no array \['film'\]"), (None, "no array None"), ("", "no array ''")])
def test_a_name_that_no_array_has(saved, name, said):
    reads = [saved.scalar, lambda name: saved.fields(0, [name])]
    for read in reads + [lambda name: saved.fields(0, name)] * isinstance(name, str):
        with pytest.raises(UnknownName, match=said) as refused:
            read(name)
        assert isinstance(refused.value, KeyError)


def test_a_single_name_is_a_list_of_one(saved):
    assert saved.fields(0, "film").keys() == saved.fields(0, (name for name in ["film"])).keys() == {"film"}


def test_entries_may_be_numbers_of_numpy(saved):
    assert saved.fields(np.int64(2))["film"][0, 0] == 3.5 and saved.feature_x(np.uint8(2)) == 2e-5
