"""Fields that are read once."""

import numpy as np

from tehl_taichi.march.zoom import read_once
from tehl_taichi.march.zoom.read_once import ReadOnce


class Counted:
    def __init__(self):
        self.x, self.read = np.arange(3.0), []

    def __len__(self):
        return 7

    def fields(self, n, names):
        self.read += [(n, name) for name in names]
        return {name: np.full(10, float(n) + (name == "film")) for name in names}


def test_fields_are_read_once(monkeypatch):
    store = Counted()
    reader = ReadOnce(store)
    for names in (("pressure",), ("pressure", "film"), ("film",)):
        assert {name: field[0] for name, field in reader.fields(2, names).items()} == {
            name: 2.0 + (name == "film") for name in names}
    assert store.read == [(2, "pressure"), (2, "film")] and len(reader) == 7 and reader.x is store.x


def test_without_room_they_are_read_again(monkeypatch):
    monkeypatch.setattr(read_once, "BYTES", 100.0)
    store = Counted()
    reader = ReadOnce(store)
    for n in (0, 1, 0, 1):
        assert reader.fields(n, ("pressure",))["pressure"][0] == n
    assert store.read == [(0, "pressure"), (1, "pressure"), (1, "pressure")]
