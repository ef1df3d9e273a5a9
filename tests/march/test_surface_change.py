"""A passage sees what plastic flow changed of its surfaces."""

from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import tehl_taichi as tehl
from tehl_taichi.fatigue.assessment import Snapshots
from tehl_taichi.march.feature_gap import sink, subtract
from tehl_taichi.march.passage import march
from tehl_taichi.plastic import elastic_loads
from tehl_taichi.plastic.surface_change import SurfaceChange
from tehl_taichi.scene.scales import Scales

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


@pytest.mark.parametrize("mirrored", [True, False])
def test_between_its_places_it_is_smooth_along_and_across(mirrored):
    """A dent known at every 10 um, 40 um wide: to half a percent of its depth anywhere, exact on its places, nothing beyond."""
    def dent(x, y):
        return np.exp(-((x[None] / 4e-5) ** 2) - (y[:, None] / 4e-5) ** 2)

    x, y = np.arange(-12, 13) * 1e-5, np.arange(0 if mirrored else -12, 13) * 1e-5
    change = SurfaceChange("a", x, y, dent(x, y).T, mirrored)
    assert np.array_equal(change.at(x, y), dent(x, y))
    fine = np.linspace(-1.1e-4, 1.1e-4, 89)
    assert np.abs(change.at(fine, fine) - dent(fine, fine)).max() < 0.005
    assert np.array_equal(change.at(fine, fine), change.at(fine, fine[::-1])[::-1]) or not mirrored
    assert not change.at(np.array([-2e-4, 2e-4]), fine).any() and not change.at(fine, np.array([2e-4])).any()


@pytest.mark.parametrize("X", [-0.9, 0.0, 0.6])
def test_what_sank_moves_with_its_own_surface(X):
    """A dent at x' = 0.1 a of each surface; b moves 5/3 as far as the first feature."""
    a, x = 3e-4, np.linspace(-0.5, 0.5, 41)
    dent = np.exp(-(((x - 0.1) / 0.1) ** 2))[:, None] * 1e-6
    levels = SimpleNamespace(X=np.linspace(-3, 3, 241), Y=np.zeros(1), scales=SimpleNamespace(a=a, h=1e-6))
    surfaces = [SimpleNamespace(name="a", pace=1.0), SimpleNamespace(name="b", pace=5 / 3)]
    for surface in surfaces:
        gap = np.zeros((1, 241))
        sink(gap, levels, surfaces, [SurfaceChange(surface.name, x * a, np.zeros(1), dent, True)], X)
        assert levels.X[gap[0].argmax()] == pytest.approx(0.1 + surface.pace * X, abs=0.0126) and gap.max() > 0.95


@pytest.mark.parametrize("x, y, moved", [(0.0, 0.2, 0.0), (0.1, -0.3, 0.5), (-0.2, 0.0, -0.7)])
def test_the_gap_is_narrow_where_the_feature_is(x, y, moved):
    a = Scales.of(GEAR).a
    feature, = GEAR.replace(**{"feature.x": x * a, "feature.y": y * a}).features
    levels = SimpleNamespace(X=np.linspace(-2, 2, 161), Y=np.linspace(-1, 1, 81), scales=SimpleNamespace(a=a, h=1e-6))
    gap = np.zeros((81, 161))
    subtract(gap, levels, feature, moved)
    row, column = np.unravel_index(gap.argmin(), gap.shape)
    assert (levels.X[column], levels.Y[row]) == pytest.approx((x + moved, y), abs=0.0126)
    assert gap.min() == pytest.approx(-feature.height / 1e-6, rel=0.01)
