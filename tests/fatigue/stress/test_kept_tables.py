"""Tables of unit loads that operators share."""

import numpy as np

from tehl_taichi.fatigue.stress import kept_tables, row_stress
from tehl_taichi.fatigue.stress.kept_tables import KeptTables
from tehl_taichi.fatigue.stress.row_stress import RowStress

X, Y, DEPTHS = np.arange(24) * 11e-6, np.arange(9) * 7e-6, [2e-6, 5e-6]


def test_operators_of_other_rows_take_the_same_tables(monkeypatch):
    made, unit_load = [], row_stress.unit_load
    monkeypatch.setattr(row_stress, "unit_load", lambda *given: (made.append(given[3]), unit_load(*given))[1])
    tables = KeptTables()
    for rows in ([3], [0, 4]):
        found = RowStress(X, Y, 0.3, True, True, DEPTHS, rows, tables=tables).rows
        assert len(made) == 3 * len(DEPTHS)
    np.testing.assert_allclose(found, RowStress(X, Y, 0.3, True, True, DEPTHS, [0, 4]).rows, rtol=1e-12, atol=1e-15)
    RowStress(X, Y, 0.3, True, True, [9e-6], [0, 4], tables=tables)
    assert made[-3:] == [9e-6] * 3


def test_without_room_they_are_made_again(monkeypatch):
    monkeypatch.setattr(kept_tables, "BYTES", 100.0)
    tables, made = KeptTables(), []
    for key in "aabb":
        tables.of(key, lambda key=key: (made.append(key), np.zeros(10))[1])
    assert made == ["a", "b", "b"]
