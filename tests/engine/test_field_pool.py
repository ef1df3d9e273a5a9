"""Fields that go from owner to owner."""

import gc

import numpy as np
import pytest

from tehl_taichi.engine import field_pool


class Owner:
    """Of a table."""


@pytest.mark.parametrize("columns", [1, 6612, 6613, 9912, 9913, 16929, 23951, 66177, 89660, 10**6])
def test_a_table_is_not_much_larger_than_wanted(columns):
    size = field_pool._capacity(columns)
    assert columns <= size and (size == 6612 or size - field_pool.SKEW < 1.5 * columns)
    assert field_pool._capacity(size) == size


@pytest.mark.parametrize("clean", [True, False])
def test_a_table_whose_owner_is_gone_is_used_again(taichi_cpu, clean):
    first, other = Owner(), Owner()
    mine, theirs = (field_pool.lease(owner, 3, 2, 7000) for owner in (first, other))
    assert mine is not theirs and mine.shape == (3, field_pool._capacity(7000)) and not mine.to_numpy().any()
    mine.fill(2.0)
    del first
    gc.collect()
    again = field_pool.lease(other, 3, 2, 6000, clean=clean)
    assert again is mine and np.unique(again.to_numpy()) == (0.0 if clean else 2.0)


def test_a_table_of_slots_has_a_column_a_row(taichi_cpu):
    owner = Owner()
    assert field_pool.lease(owner, 0, 2, 6000, 5).shape == (field_pool._capacity(6000), 5)
    assert field_pool.lease(owner, 2, 2, 6000, each=3).shape == (2, 3 * field_pool._capacity(6000))
