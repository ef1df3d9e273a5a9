"""Time derivatives along the path of the oil."""

import numpy as np
import pytest

from tehl_taichi.pressure.storage import Storage, bdf, carried, followed, third_order


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


@pytest.mark.parametrize("cells, left", [(0.0, 1.0), (1.0, 0.5), (2.0, 0.25), (3.0, 0.125)])
def test_each_whole_cell_takes_out_half_of_the_shortest_wave(cells, left):
    """And nothing of a polynomial of degree 7; parts of a cell are interpolated as they are."""
    i, inner = np.arange(40), slice(8, -8)
    wave = (-1.0) ** i
    assert followed([wave], [cells])[inner] == pytest.approx(left * carried(wave, cells)[inner], abs=1e-12)
    smooth = ((i - 20) / 20.0) ** 7
    assert followed([smooth], [cells])[inner] == pytest.approx(carried(smooth, cells)[inner], abs=1e-12)
    assert np.array_equal(followed([wave], [0.37]), carried(wave, 0.37))
    both = followed([3 * wave, smooth * wave], [cells, 1.0])
    assert both[inner] == pytest.approx((3 * followed([wave], [cells]) + followed([smooth * wave], [1.0]))[inner], abs=1e-12)


@pytest.mark.parametrize("cells", [0.0, 1.0, 0.37, 1.064, 3.5])
def test_carried_is_a_shift(cells):
    """Of fifth-degree polynomials exactly, beyond what came in at the border."""
    x = np.linspace(-1, 1, 41)
    for power in range(6):
        found, exact = carried(x[None] ** power, cells)[0], (x - cells * (x[1] - x[0])) ** power
        inside = slice(int(np.ceil(cells)) + 3, -2)
        np.testing.assert_allclose(found[inside], exact[inside], atol=1e-12)
    np.testing.assert_allclose(carried(np.ones(9), cells), 1.0)


def test_third_order_difference():
    x = np.linspace(0, 1, 21)
    for power in range(4):
        exact = power * x ** max(power - 1, 0) * (x[1] - x[0])
        np.testing.assert_allclose(third_order(x**power)[2:-1], exact[2:-1], atol=1e-14)


@pytest.mark.usefixtures("taichi_cpu")
@pytest.mark.parametrize("courant", [1.0, 0.5, 3.0])
def test_a_film_carried_by_the_oil_stores_nothing(courant):
    """rho H that moves with the oil, and rho H at rest: the storage term with the Couette flow is 0 and d(rho H)/dX."""
    from tehl_taichi.pressure import fields
    from tehl_taichi.pressure.equations import Equations
    from tehl_taichi.pressure.levels import Levels
    from tehl_taichi.pressure.one_temperature import OneTemperature
    from tehl_taichi.scene import scene
    from tehl_taichi.scene.scales import Scales

    description = scene("smooth-line").replace(**{"thermal.on": False})
    levels = Levels(description, Scales.of(description), 128, 0)
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
    storage.lengths, storage.old = [1.0, 1.0], [None] * 3
    assert [storage._order(dT, at_rest) for dT, at_rest in ((1.0, 0.1), (0.5, 0.1), (1.0, 0.9))] == [3, 2, 2]
