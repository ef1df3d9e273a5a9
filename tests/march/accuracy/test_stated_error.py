"""How large a stated error is: series of grids whose limit is known, and what companion runs are."""

import math

import pytest

from tehl_taichi.march.accuracy.coarse_runs import scenes
from tehl_taichi.march.accuracy.error_bars import estimated_error, observed_order
from tehl_taichi.scene import scene
from tehl_taichi.scene.timeline import total_steps


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("size", [0.03, -0.03])
def test_the_stated_error_covers_the_real_one_and_not_much_more(order, size):
    """v = 1 + c h^order on three grids: the finest is off by |c| h^order, the last difference is 2^order - 1 times that."""
    values = [1 + size * 2.0 ** (-order * level) for level in range(3)]
    assert observed_order(values) == pytest.approx(order)
    assert 1.0 - 1e-9 < estimated_error(values)[0] / abs(values[-1] - 1) < 3.0 + 1e-9


def test_two_grids_state_more_than_their_difference_and_one_nothing():
    """The only difference may be the whole error of order 1, and more; back and forth more than the last one."""
    assert estimated_error([1.4, 1.1])[0] == pytest.approx(0.45) and math.isnan(estimated_error([1.0])[0])
    assert estimated_error([1.0, 1.2, 1.1])[0] == pytest.approx(0.175)


def test_companions_go_the_same_way_on_half_and_quarter_the_cells():
    own = scene("gear").replace(width=4e-4, **{"grid.nx": 128, "grid.ny": 64, "time.steps": 24, "fatigue.depths": []})
    (quarter, half), refused = scenes(own)
    assert not refused
    for companion, part in ((half, 2), (quarter, 4)):
        assert (companion.grid.nx, companion.grid.ny) == (128 // part, 64 // part)
        assert total_steps(companion) * part == total_steps(own) == 24
        assert companion.replace(**{"grid.nx": 128, "grid.ny": 64, "time.steps": 24}) == own
