"""The guess for the next step."""

import numpy as np
import pytest

from tehl_taichi.march.guess import Guess, extrapolated

X = np.arange(120.0)
ROWS = np.linspace(1.0, 0.0, 5)[:, None]


def bump(centre, width=4.0):
    return np.exp(-(((X - centre) / width) ** 2))


def contact(at):
    """A pattern that moves with the feature, and at rest one that grows with the square of time."""
    return ROWS * bump(20.0 + at) + (1.0 + 0.01 * at * at) * bump(90.0) * (1 + 0 * ROWS)


@pytest.mark.parametrize("state", [None, "kept"])
def test_moving_and_resting_patterns_are_both_foreseen(state):
    guess = Guess(2, contact(0.0), 0.0, {}, "P")
    for at in (1.0, 2.0, 3.0, 4.0):
        guess.accept(contact(at), at)
    if state:
        guess = Guess(2, None, None, guess.state(), "P")
    error = np.abs(guess.next(5.0) - contact(5.0)).max()
    assert error < 2e-5
    assert np.abs(contact(4.0) - contact(5.0)).max() > 0.1


def test_one_state_is_its_own_guess():
    assert np.array_equal(Guess(2, contact(0.0), 0.0, {}, "P").next(1.0), contact(0.0).astype(np.float32))


def test_layers_of_a_field_are_trusted_together():
    layers = np.stack([contact(0.0), contact(0.0)])
    guess = Guess(1, layers, 0.0, {}, "T")
    for at in (1.0, 2.0, 3.0):
        guess.accept(np.stack([contact(at), contact(at)]), at)
    assert guess.next(4.0).shape == layers.shape


def test_numbers_follow_a_polynomial():
    at = [4.0, 3.0, 1.0]
    assert extrapolated([q**2 for q in at], at, 6.0) == pytest.approx(36.0)
    assert extrapolated([7.0], [1.0, 0.0], 2.0) == 7.0
