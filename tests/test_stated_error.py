"""How large a stated error is: series of grids whose limit is known, and what companion runs are."""

import math

import pytest

from tehl_taichi.scene import scene


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("size", [0.03, -0.03])
def test_the_stated_error_covers_the_real_one_and_not_much_more(order, size):
    """v = 1 + c h^order on three grids: the finest is off by |c| h^order."""
    from tehl_taichi.solvers.steady import estimated_error, observed_order

    values = [1 + size * 2.0 ** (-order * level) for level in range(3)]
    assert observed_order(values) == pytest.approx(order)
    assert 1.0 < estimated_error(values) / abs(values[-1] - 1) < 2.0


def test_two_grids_state_their_difference_and_one_nothing():
    """Of order 2 the finer one is off by a third of it."""
    from tehl_taichi.solvers.steady import estimated_error

    assert estimated_error([1.4, 1.1]) == pytest.approx(0.3) and math.isnan(estimated_error([1.0]))
    assert estimated_error([1.0, 1.2, 1.1]) == pytest.approx(0.1)  # back and forth: no order to be believed


def test_companions_go_the_same_way_on_half_and_quarter_the_cells():
    from tehl_taichi.post.estimate import companions

    from tehl_taichi.simulation import total_steps

    own = scene("gear").replace(**{"grid.nx": 128, "grid.ny": 32, "time.steps": 24})
    quarter, half = companions(own)
    for companion, part in ((half, 2), (quarter, 4)):
        assert (companion.grid.nx, companion.grid.ny) == (128 // part, 32 // part)
        assert total_steps(companion) * part == total_steps(own) == 24
        assert companion.replace(**{"grid.nx": 128, "grid.ny": 32, "time.steps": 24}) == own
