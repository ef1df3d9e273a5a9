"""Peaks that a grid does not resolve."""

import numpy as np
import pytest

from tehl_taichi.march.peaks import peak, ripple, unresolved_peak

X = np.linspace(-1.5, 1.5, 97)[:, None]
Y = np.linspace(0, 1, 17)[None, :]


def hertz():
    return np.sqrt(np.maximum(1 - X**2 - Y**2, 0.0))


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("fall, found", [(1, True), (2, True), (3, False)])
def test_a_free_edge_behind_the_largest_pressure(fall, found, turned):
    """It falls to under half after 1, 2, 3 cells; either order of the axes."""
    field, at = hertz(), 70
    field[at - 20 : at + fall] = 2.0
    field[at, 3] = 2.6
    field[at + fall :] = 1.2
    field = field.T if turned else field
    assert peak(field) == ((3, at) if turned else (at, 3))
    assert unresolved_peak(field) is found


@pytest.mark.parametrize("place", [(0, 5), (96, 5), (40, 0), (40, 16)])
def test_a_plateau_at_the_border_is_resolved(place):
    field = np.ones((97, 17))
    field[place] = 1.5
    assert peak(field) == place and not unresolved_peak(field)


def test_smooth_pressures_are_resolved():
    assert not unresolved_peak(hertz()) and not unresolved_peak(hertz()[:, :1])
    bump = 2 * np.exp(-((X - 0.3) ** 2 + Y**2) / 0.05**2)  # half of it 0.042 away: 1.3 cells
    assert unresolved_peak(hertz() + bump) and not unresolved_peak(hertz() + bump.clip(0, 0.8))


def test_a_ripple_is_told_from_spikes_and_edges():
    """A wave of 1 % over ten nodes is seen with its amplitude; kinks, a spike, a jump and the edge of Hertz are none."""
    wave = np.zeros_like(hertz())
    wave[40:54, 2:5] = (0.01 * (-1.0) ** np.arange(14))[:, None]
    assert ripple(hertz() + wave) == pytest.approx(0.01, rel=0.05)
    assert ripple(-hertz() - wave) == pytest.approx(0.01, rel=0.05)
    spike, jump, kink = (np.zeros_like(hertz()) for _ in range(3))
    spike[60, 3], jump[60:, 3], kink[:, :] = 1.0, 0.5, np.abs(X - 0.2)
    for quiet in (0 * hertz(), spike, jump, kink):
        assert ripple(hertz() + quiet) < 1e-4
    assert ripple(wave[:9]) == 0.0  # too few nodes to tell
