"""Arrays that a caller gives: masks, complex numbers, words."""

import numpy as np
import pytest

from tehl_taichi.errors import SceneError
from tehl_taichi.values.arrays import floats

NUMBERS = np.random.default_rng(7).integers(-9, 9, (4, 3))


@pytest.mark.parametrize("form", [np.array, np.ndarray.tolist, np.float32, np.ma.array, lambda many: many.astype(object)])
def test_numbers_of_every_kind_are_floats(form):
    found = floats("p", form(NUMBERS), "numbers")
    assert type(found) is np.ndarray and found.dtype == float and np.array_equal(found, NUMBERS)


@pytest.mark.parametrize("form", [lambda many: many, list, lambda many: many.astype(float)])
def test_masked_numbers_are_nan(form):
    mask = np.random.default_rng(8).random(NUMBERS.shape) < 0.3
    found = floats("p", form(np.ma.array(NUMBERS, mask=mask)), "numbers")
    assert mask.any() and np.array_equal(found, np.where(mask, np.nan, NUMBERS), equal_nan=True)


@pytest.mark.parametrize("values", [NUMBERS + 0j, [1j], "x", [[1, 2], [3]], {"a": 1}, np.array(["2020-01-01"], "M8[D]"),
                                    np.array([1 + 0j], object)])
def test_anything_else_is_refused(values):
    with pytest.raises(SceneError, match="p = .* must be numbers"):
        floats("p", values, "numbers")
