"""Tiles of a film that rest in later rounds of a step: many, and only where another solution would not move them."""

import numpy as np
import pytest

from tehl_taichi.engine.simd import TILE, W
from tehl_taichi.heat import film_tables
from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march.passage import Passage, march
from tehl_taichi.march.start import steady_snapshot
from tehl_taichi.pressure import fields
from tehl_taichi.scene import scene

# its last step has columns where oil begins to slip along a wall, whose Newton steps creep
GEAR = scene("gear").replace(**{"srr": -0.12, "grid.nx": 128, "grid.ny": 32, "time.x_start": -1.4, "time.x_end": -0.5})


@pytest.mark.slow
def test_what_rests_would_hardly_move(taichi_cpu, monkeypatch):
    """Every later round is solved for all tiles, too: it differs by less than a round may leave."""
    solve, rested, differs = FilmHeat.solve, [], []

    def both(heat, again=False):
        if not again:
            return solve(heat)
        before, P = heat.temperature(), heat.levels.get(fields.P)
        heat._choose_rest()
        rested.append(heat.tile_report[:, film_tables.RESTS].mean())
        report = solve(heat, again=True)
        kept = heat.temperature()
        assert np.array_equal(P, heat.levels.get(fields.P)) and not np.array_equal(kept, before)
        heat.set_temperature(before)
        solve(heat)
        differs.append(np.abs(heat.temperature() - kept).max())
        heat.set_temperature(kept)
        return report

    monkeypatch.setattr(FilmHeat, "solve", both)
    assert sum(shot.scalars["rejected"] for shot in march(GEAR) if shot.step) == 0
    late = np.mean(rested[len(rested) // 2 :])  # once the guesses have steps to go by
    print(f"now: {late:.2f} of the tiles rest, they would change by up to {max(differs):.3f} K")
    assert late > 0.2
    assert max(differs) < 0.5 * GEAR.thermal.tolerance


@pytest.fixture(scope="module")
def start(taichi_cpu):
    """State of the steady start."""
    return steady_snapshot(GEAR).state


@pytest.fixture
def heat(start):
    """Temperatures of a film solved for, so that every tile may rest."""
    passage = Passage(GEAR, start)
    passage.advance()
    passage.heat.begin(passage.dT * passage.scales.t)
    passage.heat.solve()
    passage.heat.tile_report[:, film_tables.CHANGE] = 0.0
    return passage.heat


def resting(heat):
    heat._choose_rest()
    return heat.tile_report[:, film_tables.RESTS] > 0


@pytest.mark.parametrize("row, part, wakes", [(fields.P, 3e-4, True), (fields.P, 3e-5, False), (fields.H, 3e-3, True),
                                              (fields.H, -3e-3, True), (fields.H, 3e-4, False)])
def test_a_tile_wakes_where_pressure_or_film_has_moved(heat, row, part, wakes):
    assert resting(heat).all()
    values, (j, i) = heat.levels.get(row).copy(), (2 * W, 50)
    values[j, i] += part * (1.0 if row == fields.P else values[j, i])
    heat.levels.put(row, values)
    per = heat.levels.nx // TILE + 1
    assert list(np.flatnonzero(~resting(heat))) == [2 * per + i // TILE] * wakes


def test_a_tile_wakes_that_changed_much(heat):
    heat.tile_report[3, film_tables.CHANGE] = heat.levels.scene.thermal.tolerance
    assert list(np.flatnonzero(~resting(heat))) == [3]


def test_what_is_solved_anew_rests_nowhere(heat):
    """The first round of a step and the velocities of an accepted one are those of all tiles."""
    heat.set_temperature(heat.temperature() + 1.0)
    heat.tile_report[:, film_tables.CHANGE] = 0.0
    heat.solve()
    assert (heat.tile_report[:, film_tables.CHANGE] > 0.3).all() and not heat.tile_report[:, film_tables.RESTS].any()
