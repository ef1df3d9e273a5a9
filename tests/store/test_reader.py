"""Reading of a sound store with arguments that it does not have."""

import numpy as np
import pytest
from small_stores import store

from tehl_taichi.errors import SceneError
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


def test_entries_may_be_numbers_of_numpy(saved):
    assert saved.fields(np.int64(2))["film"][0, 0] == 3.5 and saved.feature_x(np.uint8(2)) == 2e-5
