"""Tables of unit loads that operators share."""

import numpy as np
import pytest

from tehl_taichi.fatigue.stress import rectangle, row_stress, unit_loads
from tehl_taichi.fatigue.stress.row_stress import RowStress
from tehl_taichi.values.kept_arrays import KeptArrays

X, Y, DEPTHS = np.arange(24) * 11e-6, np.arange(9) * 7e-6, [2e-6, 5e-6]


def test_operators_of_other_rows_take_the_same_tables(monkeypatch):
    made, unit_load = [], row_stress.unit_load
    monkeypatch.setattr(row_stress, "unit_load", lambda *given: (made.append(given[3]), unit_load(*given))[1])
    tables = KeptArrays(1e8)
    for rows in ([3], [0, 4]):
        found = RowStress(X, Y, 0.3, True, True, DEPTHS, rows, tables=tables).rows
        assert len(made) == 3 * len(DEPTHS)
    np.testing.assert_allclose(found, RowStress(X, Y, 0.3, True, True, DEPTHS, [0, 4]).rows, rtol=1e-12, atol=1e-15)
    RowStress(X, Y, 0.3, True, True, [9e-6], [0, 4], tables=tables)
    assert made[-3:] == [9e-6] * 3


@pytest.mark.parametrize("load", range(3))
@pytest.mark.parametrize("depth", (0.0, 4e-6))
def test_cells_of_a_grid_have_the_stresses_of_single_cells(load, depth, monkeypatch):
    """Cells that share their corners, and one by one, with four corners each; cells wider than the grid share none."""
    for sides in ((5.5e-6, 3.5e-6, 0.3), (7e-6, 3.5e-6, 0.3)):
        together = unit_loads.unit_load(load, X[:, None], Y, depth, sides)
        with monkeypatch.context() as alone:
            alone.setattr(rectangle, "_edges", lambda *_: None)
            single = unit_loads.unit_load(load, X[:, None], Y, depth, sides)
        np.testing.assert_allclose(together, single, rtol=0, atol=1e-12)
        assert np.array_equal(together, single) == (sides[0] > 6e-6)


def test_corners_of_a_grid_are_evaluated_once():
    seen = []
    rectangle._corners(lambda x, y: seen.append((x + 0 * y).size) or x * y, X[:, None], Y, 5.5e-6, 3.5e-6)
    assert seen == [(X.size + 1) * (Y.size + 1)]


@pytest.mark.parametrize("depths", ([0.0], [2e-6, 5e-6], [0.0, 5e-6]))
def test_on_the_plane_of_symmetry_two_components_vanish(depths):
    """They are left out there, not computed; loads of a mirrored half: p and q_x even, q_y odd."""
    p, qx, qy = np.random.default_rng(3).uniform(0.0, 1e9, (3, 2, X.size, Y.size))
    qy[..., 0] = 0.0
    alone, both = (RowStress(X, Y, 0.3, True, True, depths, rows)(p, qx, qy) for rows in ([0], [0, 3]))
    np.testing.assert_allclose(alone, both[:, :, :1], rtol=0, atol=1e-6 * np.abs(both).max())
    assert not alone[..., [3, 5]].any() and np.abs(both[:, :, 1, :, 3]).max() > 1e6
    apart = RowStress(X, Y, 0.3, False, False, depths, [0])(p, qx, qy)
    assert np.abs(apart[..., 3]).max() > 1e6  # no plane of symmetry
