"""Starts with features of a surface at rest, around which the film is steady."""

import numpy as np
import pytest

from tehl_taichi.march import isothermal_start, steady
from tehl_taichi.march.steady import solve_steady
from tehl_taichi.pressure import fields
from tehl_taichi.scene import Scene, scene

pytestmark = pytest.mark.usefixtures("taichi_cpu")
GEAR = scene("gear").replace(**{"srr": 2.0, "thermal.on": False, "fatigue.on": False, "grid.nx": 64, "grid.ny": 16})


def start(height):
    """SteadyResult of the gear in pure sliding, with an asperity on the surface at rest and one that will pass."""
    data = GEAR.to_dict()
    passing, = data["feature"]
    data["feature"] = [passing, {**passing, "surface": "b", "height": height}]
    description = Scene.from_dict(data)
    return solve_steady(description, description.grid.nx, description.rows)


def film(height):
    return start(height).solver.levels.get(fields.H)


def test_a_feature_at_rest_that_is_most_of_the_film_rises_from_the_smooth_contact():
    """It does not start from the Hertz pressure."""
    found = start(0.3e-6)
    assert found.report.converged and found.report.residual < 1e-6


def test_rising_leads_to_what_a_start_at_once_finds(monkeypatch):
    at_once = film(0.1e-6)
    monkeypatch.setattr(steady, "from_nothing", isothermal_start._with_rising_features)
    risen = film(0.1e-6)
    np.testing.assert_allclose(risen, at_once, rtol=2e-3)
