"""Values of numpy, pandas and xarray as plain Python values."""

import math
from pathlib import Path

import numpy as np
import pytest

from tehl_taichi.values.coerce import plain


@pytest.mark.parametrize("value, wanted", [
    (np.float32(0.5), 0.5), (np.array(3), 3), (np.bool_(True), True), (np.str_("a"), "a"), (np.longdouble("0.25"), 0.25),
    (np.array([[1, 2], [3, 4]]), ((1, 2), (3, 4))), (range(2), (0, 1)), ([np.int8(1), (2.0,)], (1, (2.0,))),
    (Path("a/b"), "a/b"), (np.matrix([[1, 2]]), ((1, 2),)), (None, None), ("text", "text")])
def test_plain(value, wanted):
    found = plain(value)
    assert found == wanted and type(found) is type(wanted)


def test_a_masked_value_is_none():
    """Its number is what was refused, or never measured."""
    assert plain(np.ma.masked) is None
    assert plain([np.ma.array([1.0, 2.0], mask=[True, False])]) == ((None, 2.0),)
    assert math.isnan(plain(np.ma.array([math.nan]))[0])
