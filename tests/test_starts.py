"""Thermal starts: what counts as settled, what is refused, and what the reasons say."""

import numpy as np
import pytest

pytestmark = pytest.mark.usefixtures("taichi_cpu")


def blocks(*levels):
    """Mean temperatures of blocks, newest first: a film of three nodes in two columns, the second without load."""
    return [np.array([[[level, 1e3 * n]]] * 3, float) for n, level in enumerate(levels)]


LOADED = np.array([[True, False]])


def test_an_oscillation_is_not_settled():
    from tehl_taichi.march.settle import FLUTTER, SETTLED, _unsettled

    swing = [100.0 + 15 * (-1) ** n for n in range(16)]
    assert _unsettled(blocks(*swing), LOADED) > FLUTTER
    flutter = [100.0 + 0.3 * (-1) ** n for n in range(16)]
    assert _unsettled(blocks(*flutter), LOADED) < SETTLED < _unsettled(blocks(*flutter[:2]), LOADED)
    assert _unsettled(blocks(100.01, 100.0, 90.0), LOADED) == pytest.approx(0.01)
    assert _unsettled(blocks(100.0, 102.0, 104.0, 106.0), LOADED) > 1.0  # it drifts


def film(**changes):
    from test_thermal import film, thermal

    return film(thermal(**changes), 64)


def test_held_temperatures_and_failed_columns_are_no_state():
    from tehl_taichi.heat.energy import HOT

    heat, _ = film()
    heat.start()
    assert heat.sound
    heat.T[2, 0, 30] = HOT
    assert heat.held == 1 and not heat.sound
    heat.T[2, 0, 30] = 100.0
    heat.report.failed = 2
    assert not heat.sound



def cold(name="smooth-line", **changes):
    """A thick film of cold oil at 23 m/s, on 64 columns: by turns its temperatures swing by 80 K."""
    from test_thermal import thermal

    return thermal(name, **{"grid.nx": 64, "grid.ny": 16, "hertz_pressure": 0.309e9, "srr": -1.139, "speed": 22.65,
                            "temperature": 21.75, "bodies.b.E": 138.9e9, **changes})
