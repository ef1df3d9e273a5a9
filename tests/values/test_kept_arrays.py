"""Arrays that are kept as long as there is room."""

import numpy as np

from tehl_taichi.values.kept_arrays import KeptArrays


def test_without_room_arrays_are_made_again():
    tables, made = KeptArrays(100.0), []
    for key in "aabb":
        tables.of(key, lambda key=key: (made.append(key), np.zeros(10))[1])
    assert made == ["a", "b", "b"]
