"""Fields that are read once."""

import numpy as np

from tehl_taichi.march.zoom.read_once import ReadOnce


class Counted:
    def __init__(self):
        self.x, self.read = np.arange(3.0), []

    def __len__(self):
        return 7

    def fields(self, n, names):
        self.read += [(n, name) for name in names]
        return {name: np.full(10, float(n) + (name == "film")) for name in names}


def test_fields_are_read_once():
    store = Counted()
    reader = ReadOnce(store)
    for names in (("pressure",), ("pressure", "film"), ("film",)):
        assert {name: field[0] for name, field in reader.fields(2, names).items()} == {
            name: 2.0 + (name == "film") for name in names}
    assert store.read == [(2, "pressure"), (2, "film")] and len(reader) == 7 and reader.x is store.x
