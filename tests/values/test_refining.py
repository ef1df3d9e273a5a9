"""From the nodes of a grid to those of a finer one."""

import numpy as np
import pytest

from tehl_taichi.values.refining import Refining, matrix


@pytest.mark.parametrize("points, degree", [(2, 1), (4, 3), (6, 5)])
@pytest.mark.parametrize("factor", [2, 4, 8, 16])
def test_polynomials_come_out_exactly(points, degree, factor):
    x = np.arange(12.0)
    fine = np.arange(11 * factor + 1) / factor
    found = matrix(factor, 12, points) @ (x - 4.3) ** degree
    assert np.allclose(found, (fine - 4.3) ** degree, rtol=0, atol=1e-9 * 8**degree)


def test_a_mirror_is_one():
    """Even powers of the distance from the plane of symmetry are exact up to there, odd ones are mirrored."""
    x, fine = np.arange(10.0), np.arange(37) / 4
    assert np.allclose(matrix(4, 10, 6, True) @ x**4, fine**4, atol=1e-9)
    near = matrix(4, 10, 2, True) @ x
    assert np.allclose(near, fine)
    assert np.allclose(matrix(4, 10, 6, True, True) @ x**5, fine**5, atol=1e-9)  # odd ones with the other sign there


def test_a_part_is_that_of_the_whole():
    rng = np.random.default_rng(1)
    field = rng.random((7, 9))
    whole = Refining((0, 0), (25, 33), 4, (7, 9), True).smooth(field)
    part = Refining((3, 5), (8, 11), 4, (7, 9), True).smooth(field)
    assert np.array_equal(part, whole[3:11, 5:16])
    assert np.array_equal(whole[::4, ::4], field)


def test_a_field_keeps_its_precision():
    field = np.linspace(40.0, 200.0, 63).reshape(7, 9)
    fine = Refining((3, 5), (8, 11), 4, (7, 9), True)
    single = fine.smooth(field.astype(np.float32))
    assert single.dtype == np.float32 and fine.smooth(field).dtype == float
    assert np.allclose(single, fine.smooth(field), rtol=0, atol=1e-4)


def test_pressure_is_linear_beside_dry_nodes_and_never_negative():
    field = np.array([[0.0, 0.0, 0.0, 1.0, 4.0, 5.0, 4.0, 1.0, 0.0, 0.0]])
    found = Refining((0, 0), (1, 19), 2, (1, 10), False).pressure(field)[0]
    assert (found >= 0).all() and np.array_equal(found[::2], field[0])
    assert found[5] == 0.5 and found[15] == 0.5  # a cubic would go below 0 there
    assert found[9] == pytest.approx((-1 + 9 * 4 + 9 * 5 - 4) / 16)
