"""The guess for the next step."""

import numpy as np
import pytest

from tehl_taichi.engine.simd import W
from tehl_taichi.heat import extrapolation, film_tables
from tehl_taichi.heat.temperatures import FilmHeat
from tehl_taichi.march.extrapolation import StateExtrapolation, extrapolated
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import scene
from tehl_taichi.scene.scales import Scales

X = np.arange(129.0)
TINY = 1e-37
ROWS = np.linspace(1.0, 0.0, 6)[:, None]  # in two blocks, the second not full


def bump(centre, width=4.0):
    return np.exp(-(((X - centre) / width) ** 2))


def contact(at):
    """A pattern that moves with the feature, and at rest one that grows with the square of time."""
    return ROWS * bump(20.0 + at) + (1.0 + 0.01 * at * at) * bump(90.0) * (1 + 0 * ROWS)


class Pressure:
    """A table with a pressure, and guesses about it."""

    def __init__(self, rows, order, P, at=0.0, state=None):
        description = scene("pitch-line").replace(**{"thermal.on": False})
        self.levels = Levels(description, len(X) - 1, rows - 1)
        self.P = P
        self.guess = StateExtrapolation(self.levels, order, at, state or {})

    @property
    def P(self):
        return self.levels.get(fields.P)

    @P.setter
    def P(self, values):
        self.levels.put(fields.P, values)

    def accept(self, P, at):
        self.P = P
        self.guess.accept(at)

    def next(self, at):
        """The guess, whatever is in the table inside; the border keeps what it has."""
        self.P = np.where(self.levels.get(fields.MASK) > 0, 0.7, self.P)
        self.guess.put(at)
        return self.P


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("state", [None, "kept"])
@pytest.mark.parametrize("step, bound", [(1.0, 2e-5), (0.6, 2e-4)])  # the latter interpolated
def test_moving_and_resting_patterns_are_both_foreseen(state, step, bound):
    pressure = Pressure(6, 2, contact(0.0))
    for n in range(1, 5):
        pressure.accept(contact(n * step), n * step)
    if state:
        kept = pressure.guess.state()
        del pressure  # the next one takes its tables, with their kernels
        pressure = Pressure(6, 2, contact(4 * step), 4 * step, kept)
    error = np.abs(pressure.next(5 * step) - contact(5 * step)).max()
    assert error < bound
    assert np.abs(contact(4 * step) - contact(5 * step)).max() > 0.1


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("rows", [np.ones((1, 1)), ROWS])
@pytest.mark.parametrize("kept", [False, True])
def test_what_differs_from_the_start_moves_where_no_outermost_row_tells(rows, kept):
    """One row, and a pressure that ends before the last one: a feature on top of what stays and changes."""
    def passing(at):
        return rows * ((1.0 + 0.01 * at) * bump(60.0, 25.0) + 0.3 * bump(20.0 + at))

    pressure = Pressure(len(rows), 1, rows * bump(60.0, 25.0))
    for at in (30.0, 31.0, 32.0, 33.0):
        pressure.accept(passing(at), at)
    if kept:
        state = pressure.guess.state()
        del pressure
        pressure = Pressure(len(rows), 1, passing(33.0), 33.0, state)
    inner = (..., slice(1, -1))  # at the border the pressure is given
    error, moved = np.abs(pressure.next(34.0) - passing(34.0))[inner].max(), np.abs(passing(33.0) - passing(34.0)).max()
    print(f"now: {error:.1e} of {moved:.1e}")
    assert error < 0.015 * moved


@pytest.mark.slow
@pytest.mark.usefixtures("taichi_cpu")
def test_a_guess_is_judged_by_what_it_said_not_made_twice(monkeypatch):
    """From the fourth state on; the same bits as without the memory, also after a step that was taken in parts."""
    pressure, made, look = Pressure(6, 2, contact(0.0)), [], StateExtrapolation._look
    other = Pressure(6, 2, contact(0.0))
    at = 0.0
    for to in (1.0, 2.0, 3.0, 4.0, 5.0, 5.5, 6.0, 7.0):
        told = pressure.next(6.0 if to == 5.5 else to)
        other.P = contact(at)
        other.guess = StateExtrapolation(other.levels, 2, at, pressure.guess.state())
        assert np.array_equal(told, other.next(6.0 if to == 5.5 else to)), to
        with monkeypatch.context() as watched:
            watched.setattr(StateExtrapolation, "_look", lambda self, *args: made.append(args[-1]) or look(self, *args))
            pressure.accept(contact(to), to)
        assert bool(made) == (to < 4.0 or to == 5.5), to
        at = to
        made.clear()


@pytest.mark.usefixtures("taichi_cpu")
def test_one_state_is_its_own_guess():
    """As the memory has it; the border to the last bit."""
    P = contact(0.0)
    found = Pressure(6, 2, P).next(1.0)
    kept = np.where(P < TINY, found, P.astype(np.float32))  # single precision may take such numbers to be 0
    assert np.array_equal(found[:, 1:-1], kept[:, 1:-1]) and found[P < TINY].max() < TINY
    assert np.array_equal(found[:, [0, -1]], P[:, [0, -1]])


@pytest.mark.usefixtures("taichi_cpu")
def test_no_guess_is_negative_or_changes_the_border():
    """There the pressure is given: that of the oil beyond it."""
    def falling(at):
        P = (1.0 - 0.19 * at) * (1 + 0 * contact(0.0))
        P[:, [0, -1]] = 0.1, 0.0
        return P

    pressure = Pressure(6, 3, falling(0.0))
    for at in (1.0, 2.0, 3.0, 4.0, 5.0):
        pressure.accept(falling(at), at)
    assert not pressure.next(6.0)[:, 1:-1].any() and pressure.next(5.2)[:, 1:-1] == pytest.approx(0.012, abs=1e-5)
    assert (pressure.P[:, 0] == 0.1).all() and not pressure.P[:, -1].any()


def test_numbers_follow_a_polynomial():
    at = [4.0, 3.0, 1.0]
    assert extrapolated([q**2 for q in at], at, 6.0) == pytest.approx(36.0)
    assert extrapolated([7.0], [1.0, 0.0], 2.0) == 7.0


class Film:
    """Temperatures of a film that a test makes, with their last two states; changes: of its scene."""

    def __init__(self, **changes):
        gear = scene("gear").replace(**{"grid.nx": 128, "grid.ny": 32, **changes})
        scales = Scales.of(gear)
        self.heat = FilmHeat(Levels(gear, 128, gear.rows, full=False), 1e-3 * scales.t)
        self.put(0.0)
        self.keep()

    def at(self, at):
        """A pattern that moves with the feature, and at rest one that grows with time; not the same across the film."""
        n, rows = np.arange(self.heat.nz)[:, None, None], np.linspace(1.0, 0.0, self.heat.levels.ny + 1)[:, None]
        i = np.arange(self.heat.levels.nx + 1.0)
        moving, resting = np.exp(-(((i - 25.0 - at) / 5.0) ** 2)), np.exp(-(((i - 95.0) / 5.0) ** 2))
        return 60.0 + 0.5 * n + (20.0 + n) * rows * moving + (10.0 + 0.2 * at) * resting

    def put(self, at):
        self.heat.set_temperature(self.at(at))

    def keep(self):
        for kind, last in ((film_tables.TNN, film_tables.TN), (film_tables.TN, film_tables.T)):
            self.heat.columns.put_nodes(kind, self.heat.columns.nodes(last))
        self.heat.T = self.heat.temperature()

    def accept(self, guess, at):
        self.put(at)
        guess.accept(at)
        self.keep()


@pytest.mark.parametrize("kept", [False, True])
@pytest.mark.parametrize("at", [(1.0, 2.0, 3.0, 4.0), (1.7, 3.4, 5.1, 6.8)])
def test_temperatures_are_foreseen_where_they_move_and_where_they_rest(taichi_cpu, kept, at):
    film = Film()
    guess = extrapolation.TemperatureExtrapolation(film.heat, 0.0, {})
    for step in at[:-1]:
        film.accept(guess, step)
    if kept:
        state = guess.state()
        film.heat.columns.singles.put(extrapolation.STILL, np.ones_like(state["T_missed"]))
        guess = extrapolation.TemperatureExtrapolation(film.heat, 0.0, state)
    film.put(0.0)
    guess.put(at[-1])
    missed, moved = np.abs(film.heat.temperature() - film.at(at[-1])), np.abs(film.at(at[-1]) - film.at(at[-2]))
    print(f"now: {missed.max():.1e} K of {moved.max():.1f}")
    assert missed.max() < 2e-3 and moved.max() > 4.0


def test_temperatures_of_a_single_row_move_by_what_differs_from_their_start(taichi_cpu):
    film = Film(**{"feature.length": np.inf})
    assert film.heat.levels.ny == 0
    resting = film.at(0.0)  # its pattern that moves stands still here, and another one passes it
    i = np.arange(film.heat.levels.nx + 1.0)
    film.at = lambda at: resting + (at > 0) * 15.0 * np.exp(-(((i - 20.0 - at) / 5.0) ** 2))
    film.keep()
    guess = extrapolation.TemperatureExtrapolation(film.heat, 0.0, {})
    for at in (20.0, 21.5, 23.0):
        film.accept(guess, at)
    state = guess.state()
    guess = extrapolation.TemperatureExtrapolation(film.heat, 23.0, state)
    guess.put(24.5)
    missed, moved = np.abs(film.heat.temperature() - film.at(24.5)).max(), np.abs(film.at(24.5) - film.at(23.0)).max()
    print(f"now: {missed:.1e} K of {moved:.1f}")
    assert missed < 0.02 and moved > 3.0


def test_temperatures_go_on_as_they_did_once_two_steps_are_known(taichi_cpu):
    """What is at rest grows by 0.2 K a step; the difference between a start and its first step is none in time."""
    film = Film()
    guess, where = extrapolation.TemperatureExtrapolation(film.heat, 0.0, {}), (0, 0, 95)
    for at, grows in ((1.0, 0.0), (2.0, 0.0), (3.0, 0.2)):
        film.put(500.0)  # what an attempt left that failed
        guess.put(at)
        assert film.heat.temperature()[where] - film.heat.T[where] == pytest.approx(grows, abs=1e-6)
        film.accept(guess, at)


def test_no_temperature_is_guessed_outside_what_was(taichi_cpu):
    film = Film()
    guess = extrapolation.TemperatureExtrapolation(film.heat, 0.0, {})
    for step in (1.0, 2.0, 3.0):
        film.accept(guess, step)
    guess.put(600.0)  # the resting pattern would have gained 120 K
    found = film.heat.temperature()
    assert found.min() == film.heat.T.min() and found.max() == film.heat.T.max() + extrapolation.HOTTER


def test_rows_beyond_the_last_one_are_guessed_like_it(taichi_cpu):
    film = Film()
    guess = extrapolation.TemperatureExtrapolation(film.heat, 0.0, {})
    for step in (1.0, 2.0):
        film.accept(guess, step)
    v, nz, field = film.heat.levels, film.heat.nz, film.heat.columns.field
    last = slice(v.ny // W * (v.nx + 1) * nz, (v.ny // W + 1) * (v.nx + 1) * nz)
    lanes = field.to_numpy()
    lanes[film_tables.TN, last, 1:] = 1e9  # whatever they hold
    field.from_numpy(lanes)
    guess.put(3.0)
    lanes = field.to_numpy()[film_tables.T, last]
    assert v.ny % W == 0 and np.array_equal(lanes[:, 1:], np.repeat(lanes[:, :1], W - 1, axis=1))
