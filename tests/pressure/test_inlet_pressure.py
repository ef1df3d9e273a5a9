"""Pressure at the border of the grid against the Reynolds equation of the oil beyond it."""

import numpy as np
import pytest

import tehl_taichi as tehl
from tehl_taichi.pressure import fields
from tehl_taichi.pressure.inlet import Inlet, far
from tehl_taichi.pressure.levels import Levels
from tehl_taichi.scene import hertz

X, STEP = -8.0, 0.1  # a: thick gaps, whose bodies are rigid
BALL = tehl.scene("ball-on-disc")


def at_border(scene, x_min):
    """(y, film, border pressure) of the first column of a domain from x_min; film: of two rigid paraboloids."""
    scene = scene.replace(**{"grid.nx": 64, "grid.ny": 16, "grid.x_min": x_min, "grid.y_max": 1.3, "thermal.on": False})
    levels = Levels(scene, scene.grid.nx, scene.grid.ny)
    H = levels.X**2 / 2 + levels.scales.curvature * levels.Y[:, None] ** 2 / 2
    inlet, found = Inlet(levels), np.zeros(H.shape)
    found[inlet.border] = inlet.without_heat(H, 0.0)
    return levels.Y, H[:, 0], found[:, 0] * levels.numbers.inv_lambda / levels.scales.p_H


def flow_balance(q, H, step):
    """d/dx (H^3 dq/dx) in the middle of three points."""
    half = ((H[1:] + H[:-1]) / 2) ** 3
    return (half[1] * (q[2] - q[1]) - half[0] * (q[1] - q[0])) / step**2


def test_the_border_of_a_half_domain_is_half_of_that_of_the_whole(taichi_cpu):
    """The first column and, before the contact, the sides; not the plane of symmetry."""
    scene = BALL.replace(**{"grid.nx": 32, "grid.ny": 16, "grid.x_min": -2.0, "thermal.on": False})
    half, whole = (Inlet(Levels(scene, 32, rows, full)).border for rows, full in ((8, False), (16, True)))
    assert np.array_equal(whole[8:], half) and np.array_equal(whole, whole[::-1])
    assert half[:, 0].all() and half[-1].sum() > 10 and half[:-1].sum() == 8


def test_a_border_whose_film_answers_in_proportion_moves_twice():
    """Aitken's part of the second move is the whole way, whatever the answer."""
    inlet, q, answer = Inlet.__new__(Inlet), np.zeros(3), np.array([4.0, 1.0, 2.0])
    inlet._first()
    for _ in range(2):
        miss = answer - 1.5 * q  # of the film that the pressure q leaves
        q = q + inlet._aitken(miss) * miss
    assert q == pytest.approx(answer / 1.5)


@pytest.mark.parametrize("answer", [0.5, 1.0, 2.0, 3.0, 5.0, 9.0])
def test_a_border_agrees_with_a_film_that_answers_by_several_times_its_move(answer):
    """A film that follows the border by `answer` times a move, the other way: it swings for ever if moves stay large."""
    inlet, q, moves = Inlet.__new__(Inlet), np.zeros(2), 0
    inlet._first()
    while np.abs(miss := np.array([1.0, 2.0]) - (1 + answer) * q).max() > 1e-4:
        q, moves = q + inlet._aitken(miss) * miss, moves + 1
        assert moves < 20


@pytest.mark.parametrize("ratio", [0.25, 1.0, 3.0])
def test_beyond_rigid_paraboloids_the_oil_obeys_the_reynolds_equation(taichi_cpu, ratio):
    """Div(H^3 grad q) = dH/dX at y = 0, by the borders of three domains; R_x/R_y: ratio."""
    ellipse = {"contact.kind": "elliptic", "contact.radius_y": BALL.contact.radius_x / ratio}
    (_, before, of_before), (y, H, q), (_, after, of_after) = (
        at_border(BALL.replace(**ellipse) if ratio != 1 else BALL, X + step) for step in (-STEP, 0.0, STEP))
    j = int(np.argmin(np.abs(y)))
    rows = np.abs(np.arange(j - 1, j + 2))  # of a half domain the mirror image of the first row
    films = np.array([before[j], H[j], after[j]])
    balance = (flow_balance(np.array([of_before[j], q[j], of_after[j]]), films, STEP)
               + flow_balance(q[rows], H[rows], y[1] - y[0]))
    assert balance == pytest.approx((films[2] - films[0]) / (2 * STEP), rel=0.03)


def test_the_gap_beyond_the_border_of_a_line_is_that_of_hertz():
    places, films, _ = far(-4.0, hertz.line_gap(4.0), 1.0)
    near = places > -50.0
    assert films[near] == pytest.approx(np.array([hertz.line_gap(-x) for x in places[near]]), abs=0.01)


def test_hot_oil_at_the_border_is_thinner_beyond_it(taichi_cpu):
    scene = tehl.scene("smooth-line").replace(**{"grid.nx": 32})
    levels = Levels(scene, 32, 0)
    levels.put(fields.P, 0.0)
    levels.put(fields.LE, -1.0)  # ln of its viscosity over that of the inlet
    assert Inlet(levels).warmth() == pytest.approx(np.exp(-1.0))
