"""Averages of a residual field: of half a domain as of the whole one, with weights of their own along x and y."""

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
