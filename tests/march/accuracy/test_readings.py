"""Numbers of a start as its grid gives them: snapshots made by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from tehl_taichi.march.accuracy import readings
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

GEAR = scene("gear")
A = Scales.of(GEAR).a
X = np.linspace(-2.5, 1.5, 81) * A
SCALARS = {"h_c_m": 4e-7, "friction_coefficient": -0.04, "film_max_C": 130.0, "surface_a_max_C": 120.0,
           "surface_b_max_C": 110.0}


def shot(peak=0.0, touches=(), scalars=SCALARS):
    """A wide pressure with a peak one node wide at 1.1 a, a film with its smallest height at 0.6 a."""
    pressure = np.outer(1e9 * np.exp(-((X / A) ** 2)), np.ones(5))
    pressure[72] += peak
    film = 3e-7 + 1e-7 * np.outer((X / A - 0.6) ** 2, np.ones(5))
    contact = np.zeros(film.shape)
    contact[touches] = 1.0 if touches else 0.0
    return SimpleNamespace(fields={"pressure": pressure, "film": film, "contact": contact}, scalars=scalars, x=X,
                           feature_x=float("nan"))


def test_readings_of_a_resolved_start():
    found = readings.steady(shot(), GEAR)
    assert {name: one.value for name, one in found.items()} == pytest.approx({**SCALARS, "h_min_m": 3e-7, "p_max_Pa": 1e9})
    assert {name for name, one in found.items() if one.positive} == {"h_c_m", "h_min_m"}
    assert {name for name, one in found.items() if one.settled > 0} == {name for name in found if name.endswith("_C")}
    assert not any(one.doubt or one.lost for one in found.values())
    for name, at in (("p_max_Pa", 0.0), ("h_min_m", 0.6 * A)):
        assert found[name].cell == pytest.approx(A / 20) and found[name].place == pytest.approx((at,), abs=1e-9 * A)
    without = {name: SCALARS[name] for name in ("h_c_m", "friction_coefficient")}
    assert readings.steady(shot(scalars=without), GEAR).keys() == {*without, "h_min_m", "p_max_Pa"}


def test_a_narrow_peak_leaves_its_pressure_and_the_heat_of_the_film_there_unknown():
    found = readings.steady(shot(peak=2e9), GEAR)
    assert {name: one.doubt.code for name, one in found.items() if one.doubt} == {"p_max_Pa": "exit", "film_max_C": "exit"}
    assert not any(one.lost for one in found.values())


def test_one_node_that_touches_leaves_nothing_known():
    found = readings.steady(shot(touches=(10, 3)), GEAR)
    assert all(one.doubt == readings.TOUCH and one.lost for one in found.values())


@pytest.mark.parametrize("x, exit_", [(-0.9, False), (0.45, False), (0.5, False), (0.55, True), (1.2, True)])
def test_the_exit_begins_half_a_half_width_behind_the_middle(x, exit_):
    assert readings.is_at_exit(x * A, A) is exit_
