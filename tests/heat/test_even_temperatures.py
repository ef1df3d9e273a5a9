"""Rolling between equal bodies has the same temperatures at both walls, in every bit."""

import numpy as np
import pytest

from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march.passage import march
from tehl_taichi.scene import scene

ROLLING = scene("gear").replace(**{"srr": 0.0, "height": -1.5e-6, "grid.nx": 64, "grid.ny": 8, "fatigue.on": False,
                                   "time.steps": 4})


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("changes, even", [({}, True), ({"srr": 1e-3}, False), ({"bodies.b.k": 45.0}, False)])
def test_rolling_between_equal_bodies_is_the_same_at_both_walls(monkeypatch, changes, even):
    """Not only within rounding: behind a front, an odd part grows to solutions with the hot layer at one wall."""
    films, accept = [], FilmHeat.accept

    def keep(heat):
        accept(heat)
        films.append(heat.T)

    monkeypatch.setattr(FilmHeat, "accept", keep)
    list(march(ROLLING.replace(**changes)))
    odd = [np.abs(T - T[::-1]).max() for T in films[-3:]]
    assert films[-1].max() > ROLLING.operation.temperature + 1.0
    assert max(odd) == 0.0 if even else min(odd) > 1e-3
