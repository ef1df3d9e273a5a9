"""Peaks that a grid does not resolve."""

import numpy as np
import pytest

from tehl_taichi.march.accuracy.peaks import peak, ripple, sharpest, unresolved_peak

X = np.linspace(-1.5, 1.5, 97)[:, None]
Y = np.linspace(0, 1, 17)[None, :]


def hertz():
    return np.sqrt(np.maximum(1 - X**2 - Y**2, 0.0))


@pytest.mark.parametrize("fall, found", [(1, True), (2, True), (3, False)])
def test_a_free_edge_behind_the_largest_pressure(fall, found):
    """It falls to under half after 1, 2, 3 cells."""
    field, at = hertz(), 70
    field[at - 20 : at + fall] = 2.0
    field[at, 3] = 2.6
    field[at + fall :] = 1.2
    assert peak(field) == (at, 3)
    assert sharpest(field) == ((1.0, at) if found else (0.0, 0))


@pytest.mark.parametrize("place", [0, 96])
def test_a_peak_at_the_border_is_resolved(place):
    """Pressures there are given."""
    field = np.ones((97, 17))
    field[place, 5] = 1.5
    assert peak(field) == (place, 5) and sharpest(field)[0] == 0.0


def test_smooth_pressures_are_resolved():
    assert sharpest(hertz())[0] == sharpest(hertz()[:, :1])[0] == 0.0
    bump = 2 * np.exp(-((X - 0.3) ** 2 + Y**2) / 0.05**2)  # half of it 0.042 away: 1.3 cells
    assert sharpest(hertz() + bump)[0] == 1.0 and sharpest(hertz() + bump.clip(0, 0.3))[0] == 0.0


def test_peaks_that_leave_the_largest_unknown():
    x = np.linspace(-1, 1, 81)
    smooth = np.sqrt(1 - x**2)

    def with_peak(height, width):
        return np.maximum(smooth, height * np.exp(-np.abs(x - 0.8) / width))

    assert unresolved_peak(smooth)[0] == 0.0
    assert unresolved_peak(with_peak(0.9, 0.05)) == (pytest.approx(0.9), 72)  # 0.37 of it two cells away: up to 1.18
    assert unresolved_peak(with_peak(0.7, 0.05)) == unresolved_peak(with_peak(0.9, 0.5)) == (0.0, 0)
    assert unresolved_peak(with_peak(1.2, 0.05)) == (1.0, 72) and unresolved_peak(with_peak(1.2, 0.5))[0] == 0.0


def test_a_ripple_is_told_from_spikes_and_edges():
    """A wave of 1 % over ten nodes is seen with its amplitude; kinks, a spike, a jump and the edge of Hertz are none."""
    wave = np.zeros_like(hertz())
    wave[40:54, 2:5] = (0.01 * (-1.0) ** np.arange(14))[:, None]
    assert ripple(hertz() + wave) == (pytest.approx(0.01, rel=0.05), pytest.approx(43, abs=1))  # 40, and two on either side
    assert ripple(-hertz() - wave)[0] == pytest.approx(0.01, rel=0.05)
    spike, jump, kink = (np.zeros_like(hertz()) for _ in range(3))
    spike[60, 3], jump[60:, 3], kink[:, :] = 1.0, 0.5, np.abs(X - 0.2)
    for quiet in (0 * hertz(), spike, jump, kink):
        assert ripple(hertz() + quiet)[0] < 1e-4
    assert ripple(wave[:9])[0] == 0.0  # too few nodes to tell
