"""Where the oil of a node was: departure points of flow along y."""

import numpy as np
import pytest

from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

pytestmark = pytest.mark.usefixtures("taichi_cpu")

NODES, ROWS = 5, 16


class Sideways:
    """A film on whose rows oil moves by so many rows a step, all else at rest."""

    def __init__(self, rows):
        from tehl_taichi.engine.launches import bind
        from tehl_taichi.engine.records import Record
        from tehl_taichi.heat import paths, slots
        from tehl_taichi.heat.step import Step
        from tehl_taichi.pressure.levels import Levels

        description = scene("smooth-line").replace(**{"thermal.on": True, "grid.nx": 32, "grid.ny": ROWS, "grid.y_max": 1.0})
        levels = Levels(description, Scales.of(description), 32, ROWS)
        self.slots, self.columns, step = slots, slots.Columns(levels, NODES), Record(Step)
        step.set(inv_x=1.0, inv_y=1.0, back=1.0, back_2=2.0, near=4 / 3, far=-1 / 3)
        self.shape = NODES, ROWS + 1, 33
        self.columns.put_nodes(slots.U, np.zeros(self.shape))
        self.columns.put_nodes(slots.VY, np.full(self.shape, float(rows)))
        self.launch = bind(paths.departures, levels.S, self.columns.field, self.columns.singles.field, levels.G, NODES,
                           levels.conditions.values, step.values, np.zeros((5 * levels.fine, slots.TOLD)))

    def after(self, last, before):
        """Temperatures that the oil brings along."""
        self.columns.put_nodes(self.slots.TN, last)
        self.columns.put_nodes(self.slots.TNN, before)
        self.launch()
        return self.columns.nodes(self.slots.TS)


@pytest.mark.parametrize("rows, counted", [(0.3, 0.3), (-0.45, -0.45), (0.8, 0.5), (-3.0, -0.5)])
def test_oil_comes_from_the_side_that_it_flows_from(rows, counted):
    """A rise of 1 K a row one step ago, of 10 two steps ago; at most a row in both steps."""
    film = Sideways(rows)
    rise = np.arange(ROWS + 1.0)[None, :, None] + np.zeros(film.shape)
    inner = slice(2, -2)
    np.testing.assert_allclose(film.after(rise, 10 * rise)[:, inner],
                               (4 / 3 * (rise - counted) - 10 / 3 * (rise - 2 * counted))[:, inner], atol=1e-12)


@pytest.mark.parametrize("rows", [0.25, 0.5, -0.7, 1.0, 1.6])
def test_waves_from_row_to_row_do_not_grow(rows):
    film, noise = Sideways(rows), np.random.default_rng(5)
    last = before = noise.uniform(-1, 1, (1, ROWS + 1, 1)) + np.zeros(film.shape)
    largest = []
    for _ in range(ROWS):  # then all of it may have left
        last, before = film.after(last, before), last
        largest.append(np.abs(last).max())
    assert max(largest) < 1.5, largest
