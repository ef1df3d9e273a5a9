"""Relaxed rounds of pressure and temperatures."""

import numpy as np
import pytest

from tehl_taichi.engine.simd import TILE
from tehl_taichi.heat import film_tables
from tehl_taichi.heat.relaxation import BACK, CREEP
from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import scene

pytestmark = pytest.mark.usefixtures("taichi_cpu")
GOAL = 100.0


@pytest.fixture
def heat():
    """A FilmHeat on 64x16 cells of a line contact, at the beginning of a step."""
    description = scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16})
    levels = Levels(description, 64, 16)
    heat = FilmHeat(levels, 1e-6)
    heat.start()
    heat.begin(heat.dt)
    return heat


def relaxed(heat, rounds, x):
    """Temperatures after relaxed rounds, each a function of the temperatures before it."""
    for go in rounds:
        heat.columns.put_nodes(film_tables.LAST, x)
        heat.set_temperature(go(x))
        heat.relax()
        x = heat.temperature()
    return x


def rounds_of(g):
    """Two rounds that leave g of the distance from the goal."""
    return [lambda x: GOAL + g * (x - GOAL)] * 2


def off(heat):
    """Temperatures 1 to 2 K from the goal, other ones at each node."""
    return GOAL + np.random.default_rng(1).uniform(1.0, 2.0, (heat.nz, heat.levels.ny + 1, heat.levels.nx + 1))


@pytest.mark.parametrize("g", [-2.0, -0.8, -0.3, 0.3, 0.6])
def test_the_second_of_linear_rounds_ends_at_their_goal(heat, g):
    np.testing.assert_allclose(relaxed(heat, rounds_of(g), off(heat)), GOAL, atol=1e-9)


@pytest.mark.parametrize("g, share", [(-9.0, BACK), (0.9, CREEP)])
def test_shares_have_limits(heat, g, share):
    x = off(heat)
    np.testing.assert_allclose(relaxed(heat, rounds_of(g), x), GOAL + (g * g - share * (g * g - g)) * (x - GOAL), atol=1e-7)


def test_each_place_has_its_own_share(heat):
    """Rounds that go to and fro before column 30 and in rows up to 8, and creep elsewhere: the goal, but beside the borders."""
    i, j = np.arange(heat.levels.nx + 1), np.arange(heat.levels.ny + 1)
    g = np.where((i[None, :] < 30) & (j[:, None] <= 8), -0.8, 0.5)
    missed = np.abs(relaxed(heat, rounds_of(g), off(heat)) - GOAL).max(axis=0)
    beside = np.zeros(missed.shape, bool)
    beside[:10, 29:31] = beside[8:10, :31] = True
    assert missed[~beside].max() < 1e-9 < missed[beside].min()


def test_quiet_places_take_the_whole_change(heat):
    x = GOAL + (off(heat) - GOAL) * 1e-4
    np.testing.assert_allclose(relaxed(heat, rounds_of(-0.8), x), GOAL + 0.64 * (x - GOAL), rtol=0, atol=1e-12)


def test_the_first_round_of_a_step_is_not_relaxed(heat):
    x = off(heat)
    relaxed(heat, rounds_of(-0.8), x)
    heat.begin(heat.dt)
    np.testing.assert_allclose(relaxed(heat, rounds_of(0.5)[:1], x), GOAL + 0.5 * (x - GOAL), atol=1e-12)


def test_tiles_that_a_round_skipped_stay_and_those_that_are_moved_wake(heat):
    skipped = np.arange(len(heat.tile_report)) % 2 == 1  # the columns from TILE on
    x = off(heat)
    heat.tile_report[:, film_tables.CHANGE] = 0.0
    relaxed(heat, rounds_of(-0.8)[:1], x)
    heat.tile_report[skipped, film_tables.RESTS] = 1.0
    moved = relaxed(heat, rounds_of(0.5)[:1], x)
    assert np.array_equal(moved[..., TILE:], (GOAL + 0.5 * (x - GOAL))[..., TILE:])
    change = heat.tile_report[:, film_tables.CHANGE]
    assert (change[~skipped] > 0.1).all() and not change[skipped].any()
    viscosity = heat.columns.get(film_tables.KEPT, heat.nz)
    heat.set_temperature(moved)
    assert np.array_equal(viscosity, heat.columns.get(film_tables.KEPT, heat.nz))
