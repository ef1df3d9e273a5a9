"""Where the oil of a node was: departure points of flow along y."""

import numpy as np
import pytest

from tehl_taichi.engine.records import Record
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.heat import departure_points, film_tables
from tehl_taichi.heat.heat_step import HeatStep
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import scene

pytestmark = pytest.mark.usefixtures("taichi_cpu")

NODES, ROWS = 5, 16


class Sideways:
    """A film on whose rows oil moves by so many rows, and columns, a step, all else at rest."""

    def __init__(self, rows, along=0.0):
        description = scene("smooth-line").replace(**{"thermal.on": True, "grid.nx": 32, "grid.ny": ROWS, "grid.y_max": 1.0})
        levels = Levels(description, 32, ROWS)
        self.slots, self.columns, step = film_tables, film_tables.FilmTables(levels, NODES), Record(HeatStep)
        step.set(inv_x=1.0, inv_y=1.0, back=1.0, back_2=2.0, near=4 / 3, far=-1 / 3)
        self.shape = NODES, ROWS + 1, 33
        self.columns.put_nodes(film_tables.U, np.full(self.shape, float(along)))
        self.columns.put_nodes(film_tables.VY, np.full(self.shape, float(rows)))
        self.launch = bind(departure_points.departures, levels.S, self.columns.field, self.columns.singles.field, levels.G,
                           NODES, levels.conditions.values, step.values, np.zeros((5 * levels.fine, film_tables.TOLD)))

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


@pytest.mark.parametrize("rows", [0.1, -0.3, 0.5])
def test_bends_between_rows_count(rows):
    """Exactly, as long as differences do not double from row to row."""
    film, y = Sideways(rows), np.arange(ROWS + 1.0)[None, :, None]
    inner = slice(3, -2)
    expected = 4 / 3 * (y - rows) ** 2 - 1 / 3 * (y - 2 * rows) ** 2 + np.zeros(film.shape)
    bent = y**2 + np.zeros(film.shape)
    np.testing.assert_allclose(film.after(bent, bent)[:, inner], expected[:, inner], atol=1e-12)


@pytest.mark.parametrize("rows", [0.1, 0.3, -0.5])
def test_a_sawtooth_of_rows_dies(rows):
    """Which moving quadratics alone leave as it is."""
    film = Sideways(rows)
    last = before = (-1.0) ** np.arange(ROWS + 1.0)[None, :, None] + np.zeros(film.shape)
    for _ in range(ROWS):
        last, before = film.after(last, before), last
    assert np.abs(np.diff(last, 2, axis=1)).max() / 4 < 0.2  # it comes in at one side


@pytest.mark.parametrize("along", [2.0, 3.4])
def test_oil_from_beyond_the_border_brings_nothing_from_other_rows(along):
    """It is the same in all of them. Until 0.8 the change from row to row was extrapolated from both first columns, and grew
    twice a step where a flooded border has a gradient along y."""
    warm = 90.0 + np.arange(ROWS + 1.0)[None, :, None] * np.linspace(9, 1, 33) + np.zeros((NODES, 1, 1))
    # one film at a time: each has its tables, and its kernels with them
    np.testing.assert_allclose(Sideways(0.3, along).after(warm, warm)[:, :, :2], 90.0, atol=1e-12)
    half = Sideways(0.0, 0.5).after(warm, warm), Sideways(0.3, 0.5).after(warm, warm)
    change = (half[1] - half[0])[:, 2:-2, 0] / (-0.3 * 9.0)
    np.testing.assert_allclose(change, 4 / 3 * 0.5, atol=1e-12)  # of half a column; two steps ago all came from beyond
