"""A passage sees what plastic flow changed of its surfaces."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import tehl_taichi as tehl
from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.march.passage import march
from tehl_taichi.plastic import elastic_loads
from tehl_taichi.plastic.surface_change import SurfaceChange

GEAR = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 2})


@pytest.fixture(scope="module")
def plain():
    return list(march(GEAR))


def test_a_lower_asperity_is_a_sunk_one(plain):
    """Half of its height taken off as a change, on the nodes of the grid: equal passages."""
    frame = elastic_loads.histories(GEAR, Snapshots(plain), GEAR.surfaces[0])
    height = GEAR.features[0].height_at(frame.x[:, None], frame.y[None])
    changes = (SurfaceChange("a", frame.x, frame.y, height / 2, True),)
    sunk, lower = list(march(GEAR, plain[0].state, changes))[-1], list(march(GEAR.replace(height=0.75e-6)))[-1]
    for name in ("film", "pressure"):
        assert_allclose(sunk.fields[name], lower.fields[name], rtol=1e-9, atol=1e-9 * np.abs(lower.fields[name]).max())
    assert np.abs(sunk.fields["film"] - plain[-1].fields["film"]).max() > 0.5e-6


def test_without_a_change_every_bit_stays(plain):
    again = list(march(GEAR, plain[0].state, ()))
    assert all(np.array_equal(one.fields[name], two.fields[name]) for one, two in zip(again, plain[1:]) for name in one.fields)
