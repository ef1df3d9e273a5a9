"""A residual field between its points and beyond them; its averages: of half a domain as of the whole one, with weights of
their own along x and y."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tehl_taichi.fatigue.stress.averaging import weights
from tehl_taichi.fatigue.stress.residual_field import ResidualField

X, Y, DEPTHS = np.arange(12) * 2e-6, np.arange(9) * 5e-6, np.array([2e-6, 6e-6])
EVEN = np.array([1, 1, 1, 0, 1, 0], bool)[:, None, None]  # xx, yy, zz, xz across y = 0; xy, yz are odd


@pytest.fixture
def sides():
    """Averaging weights along x and y: of an odd number of points each."""
    return weights(9e-6, 2e-6), weights(2e-5, 5e-6)


def field(y, along_y):
    """The same in both layers."""
    return ResidualField(X, y, DEPTHS, np.stack([along_y * np.sin(X[:, None] / 5e-6)] * 2))


def test_half_a_domain_has_the_averages_of_the_whole(sides):
    whole_y = np.concatenate([-Y[:0:-1], Y])
    half, whole = (field(y, np.where(EVEN, np.cos(y / 1e-5), np.sin(y / 1e-5))) for y in (Y, whole_y))
    found, wanted = half.averaged(*sides, True).stress, whole.averaged(*sides, False).stress[..., Y.size - 1 :]
    kept = Y.size - sides[1].size // 2  # rows whose square does not reach beyond the last one
    assert_allclose(found[..., :kept], wanted[..., :kept], atol=1e-12)


def test_what_varies_along_x_is_averaged_along_x(sides):
    along, reach = sides[0], sides[0].size // 2
    found = field(Y, np.ones((6, 1, Y.size))).averaged(*sides, True).stress[0, 0, reach:-reach, 0]
    wanted = [along @ np.sin(X[n - reach : n + reach + 1] / 5e-6) for n in range(reach, X.size - reach)]
    assert_allclose(found, wanted, atol=1e-12)


def linear(x, y, z):
    """Stresses (x, y, depths, 6): each component with slopes of its own."""
    slopes = np.array([[1, 2, 3], [-2, 1, 1], [3, 1, -1], [1, -1, 2], [2, 2, -3], [-1, 3, 1]]) * 1e12
    at = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1)
    return 1e7 + at @ slopes.T


def known(y=Y, depths=DEPTHS):
    """The linear field at the points X, y and depths."""
    return ResidualField(X, y, depths, linear(X, y, depths).transpose(2, 3, 0, 1))


def test_between_its_points_a_field_is_linear():
    x, y, z = np.array([0.0, 3.3e-6, 2.2e-5]), np.array([0.0, 1.1e-5, 4e-5]), np.array([2e-6, 3e-6, 6e-6])
    assert_allclose(known().at(x, y, z), linear(x, y, z), rtol=1e-9)


def test_up_to_the_surface_it_goes_on_and_what_acts_on_the_surface_fades():
    """xx, yy, xy lie in the surface; zz, xz and yz, which would pull at it, are zero there."""
    x, y, z = X[2:4] + 1e-6, Y[3:5], np.array([0.0, 0.5e-6, 1.5e-6])
    fading = np.where(np.isin(np.arange(6), [2, 4, 5]), (z / DEPTHS[0])[:, None], 1.0)
    assert_allclose(known().at(x, y, z), linear(x, y, z) * fading, rtol=1e-9, atol=1e-3)


def test_beyond_its_points_there_is_none():
    """Beside the first and last point, and from half as deep again as the last layer on."""
    field, inside = known(), (X[3:4], Y[3:4], DEPTHS[1:])
    for n, beyond in ((0, [-1e-9, X[-1] + 1e-9]), (1, [-1e-9, Y[-1] + 1e-9]), (2, [9e-6, 1.0])):
        assert not field.at(*(inside[:n] + (np.array(beyond),) + inside[n + 1 :])).any()
    assert_allclose(field.at(X[3:4], Y[3:4], [7.5e-6]), 0.5 * field.at(*inside), rtol=1e-9)
    assert field.at(X[[0, -1]], Y[[0, -1]], DEPTHS).all()


def test_one_row_is_that_of_all_y():
    found = known(y=Y[2:3]).at(X[:3], np.array([-1.0, 0.0, 1.0]), DEPTHS)
    assert_allclose(found, np.repeat(linear(X[:3], Y[2:3], DEPTHS), 3, axis=1), rtol=1e-9)
