"""Time derivatives along the path of the oil."""

import numpy as np
import pytest

from tehl_taichi.pressure import fields
from tehl_taichi.pressure.equations import Equations
from tehl_taichi.pressure.history import carried
from tehl_taichi.pressure.isothermal import OneTemperature
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.pressure.storage_term import Storage, bdf, third_order
from tehl_taichi.scene import scene


@pytest.mark.parametrize("lengths", [[0.3], [0.3, 0.2], [0.3, 0.2, 0.5]])
def test_backward_differences_are_exact_for_polynomials(lengths):
    rate, weights = bdf(*lengths)
    times = -np.concatenate([[0.0], np.cumsum(lengths)])
    for power in range(len(lengths) + 1):
        values = (1 + times) ** power
        assert rate * (values[0] - weights @ values[1:]) == pytest.approx(power, abs=1e-12)


def test_backward_differences_of_equal_steps():
    assert bdf(0.5)[0] == 2 and bdf(0.5, 0.5)[0] == pytest.approx(3)
    assert bdf(1, 1, 1)[1] == pytest.approx([18 / 11, -9 / 11, 2 / 11])


def columns(nx, ny=0):
    """Levels of so many cells."""
    description = scene("pitch-line" if ny else "smooth-line").replace(**{"thermal.on": False})
    return Levels(description, nx, ny)


def followed(old, lengths, cells, start=0.0):
    """What the storage term takes for the old states (newest first), a step of so many cells after the newest."""
    levels = columns(len(old[0][0]) - 1, len(old[0]) - 1)
    rest = start + 0 * old[0]
    storage = Storage(levels, {"mass": [rest, *old], "lengths": [length * levels.dx for length in lengths]})
    storage.begin(cells * levels.dx)
    frame = storage.frame
    return (frame["speed"] * third_order(rest) - levels.get(fields.QOLD)) / frame["rate"], frame


def test_the_couette_difference_is_exact_for_parabolas_in_every_inner_column():
    x = np.arange(9.0)
    assert third_order(x**2)[1:-1] == pytest.approx(2 * x[1:-1]) and not third_order(x**2)[[0, -1]].any()


@pytest.mark.usefixtures("taichi_cpu")
def test_steps_of_unequal_length_keep_their_order():
    """Parts of a step: the last one before the present one has its own length, not that of the one before."""
    levels = columns(40)
    storage = Storage(levels)
    for dT in (0.5, 0.25, 0.125):
        storage.accept(dT * levels.dx)
    storage.begin(0.1 * levels.dx)
    assert storage.frame["rate"] == pytest.approx(bdf(0.1, 0.125)[0])


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("cells, left", [(1.0, 0.5), (2.0, 0.25)])
def test_each_whole_cell_takes_out_half_of_the_shortest_wave(cells, left):
    """And nothing of a polynomial of degree 7; parts of a cell are interpolated as they are."""
    i, inner = np.arange(41.0)[None], (..., slice(8, -8))
    wave, smooth = (-1.0) ** i, ((i - 20) / 20.0) ** 7
    assert followed([wave], [], cells)[0][inner] == pytest.approx(left * carried(wave, cells)[inner], abs=1e-12)
    assert followed([smooth], [], cells)[0][inner] == pytest.approx(carried(smooth, cells)[inner], abs=1e-12)
    assert followed([wave], [], 0.37)[0] == pytest.approx(carried(wave, 0.37), abs=1e-14)


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("cells, lengths, order", [
    (1.0, [1.0, 1.0], 3), (0.3, [0.3, 0.3], 3), (1.0, [0.5], 2), (3.0, [3.0], 2)])
def test_old_states_go_their_ways_and_what_rests_stays(cells, lengths, order):
    """Rows of several blocks and lanes that no row fills; whole cells, parts of them, and a frame slower than the oil."""
    rng, shape = np.random.default_rng(3), (11, 65)
    old, rest = [rng.normal(size=shape) for _ in range(order)], rng.normal(size=shape)
    found, frame = followed(old, lengths, cells, rest)
    ways = frame["speed"] * np.cumsum([cells, *lengths][:order])
    _, weights = bdf(*[cells, *lengths][:order])
    moved = [weight * carried(q - rest, way) for weight, way, q in zip(weights, ways, old)]
    expected = rest + sum(moved)
    lost = sum((1 - 0.5 ** round(way)) * q if abs(way - round(way)) < 1e-9 else 0 * q for q, way in zip(moved, ways))
    expected[..., 4:-4] -= np.diff(lost, 8) / 256
    assert frame["states"] == order and found == pytest.approx(expected, abs=1e-10)


@pytest.mark.usefixtures("taichi_cpu")
def test_the_states_of_the_last_steps_are_those_that_were_in_the_table():
    """In turn, whatever rows they are in; the arrays to go on from, too."""
    levels = columns(32, 9)
    states = [np.random.default_rng(n).normal(size=(10, 33)) for n in range(5)]
    levels.put(fields.RHO, 2.0)
    levels.put(fields.H, states[0])
    storage = Storage(levels)
    for n, state in enumerate(states[1:], 1):
        levels.put(fields.H, state)
        storage.accept(0.1)
        kept = storage.state()["mass"]
        assert len(kept) == min(n + 1, 3) + 1 and np.array_equal(kept[0], 2 * states[0])
        assert all(np.array_equal(one, 2 * states[n - back]) for back, one in enumerate(kept[1:]))
        assert np.array_equal(Storage(levels, storage.state()).state()["mass"], kept)


@pytest.mark.parametrize("cells", [0.0, 1.0, 0.37, 1.064, 3.5])
def test_carried_is_a_shift(cells):
    """Of fifth-degree polynomials exactly, beyond what came in at the border."""
    x = np.linspace(-1, 1, 41)
    for power in range(6):
        found, exact = carried(x[None] ** power, cells)[0], (x - cells * (x[1] - x[0])) ** power
        inside = slice(int(np.ceil(cells)) + 3, -2)
        np.testing.assert_allclose(found[inside], exact[inside], atol=1e-12)
    np.testing.assert_allclose(carried(np.ones(9), cells), 1.0)


@pytest.mark.parametrize("cells", [-12, -3, 0, 2, 12])
def test_what_moves_by_whole_cells_keeps_its_values(cells):
    q = np.random.default_rng(2).random((2, 9))
    at = np.clip(np.arange(9) - cells, 0, 8)
    assert np.array_equal(carried(q, float(cells)), q[:, at])


def test_third_order_difference():
    x = np.linspace(0, 1, 21)
    for power in range(4):
        exact = power * x ** max(power - 1, 0) * (x[1] - x[0])
        np.testing.assert_allclose(third_order(x**power)[2:-1], exact[2:-1], atol=1e-14)


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("courant", [1.0, 0.5, 3.0])
def test_a_film_carried_by_the_oil_stores_nothing(courant):
    """rho H that moves with the oil, and rho H at rest: the storage term with the Couette flow is 0 and d(rho H)/dX."""
    levels = columns(128)
    equations = Equations(levels, OneTemperature(levels))
    X, dT = levels.X[None], courant * levels.dx

    def film(step):
        levels.put(fields.P, 0.0)  # no Poiseuille flow, density 1
        levels.put(fields.H, 1 + 0.1 * X + 0.1 * np.exp(-(((X + 0.5 - step * dT) / 0.4) ** 2)) * (step > 0))
        equations.film.values()

    film(0)
    storage = Storage(levels)
    for step in range(1, 6):
        film(step)
        storage.begin(dT)
        equations.evaluate()
        storage.accept(dT)
    found = levels.get(fields.R)[0, 2:-2] / levels.dx
    assert np.abs(found - 0.1).max() < (2e-3 if courant <= 1 else 0.02)


def test_third_order_is_for_steps_of_one_length():
    storage = Storage.__new__(Storage)
    storage.lengths, storage.known = [1.0, 1.0], 3
    assert [storage._order(dT, at_rest) for dT, at_rest in ((1.0, 0.1), (0.5, 0.1), (1.0, 0.9))] == [3, 2, 2]
