"""Guesses of the next state of a window."""

import numpy as np
import pytest

from tehl_taichi.march.zoom.two_frames import TwoFrames

COLUMNS = np.arange(40.0)


def state(n, resting, moving, layers):
    """Field (layers, 3, 18) of step n in a window that begins at column 4 + n, and its origin: a part at rest and one that
    moves by a column a step, both growing quadratically with n."""
    origin = 4 + n
    at = COLUMNS[origin : origin + 18]
    field = (1.0 + 0.1 * n * n) * (resting * at**2 + moving * (at - n) ** 3)
    return np.broadcast_to(field, (layers, 3, 18)) + np.arange(layers)[:, None, None], origin


def guessed(resting, moving, judged=None, run=0.0):
    """(guess, field) of step 5, after the states of steps 0 to 4; start: all 0, run: a constant."""
    frames = TwoFrames(2, np.zeros((5, 3, 40)), judged)
    for n in range(5):
        field, origin = state(n, resting, moving, 5)
        if n:
            frames.next(np.full(field.shape, run), origin, float(n))
        frames.accept(field, np.full(field.shape, run), origin, float(n))
    field, origin = state(5, resting, moving, 5)
    return frames.next(np.full(field.shape, run), origin, 5.0), field


@pytest.mark.parametrize("judged", [None, [0, 2, -1]])
@pytest.mark.parametrize("resting, moving", [(1.0, 0.0), (0.0, 1.0)])
def test_the_frame_that_was_right_is_followed(resting, moving, judged):
    """Away from the columns that came in, the quadratic growth of either part comes out exactly."""
    guess, field = guessed(resting, moving, judged)
    assert np.allclose(guess[..., 6:-6], field[..., 6:-6], rtol=1e-6, atol=1e-6 * np.abs(field).max())


def test_without_errors_to_judge_by_the_run_and_the_last_difference_are_the_guess():
    frames, (field, origin) = TwoFrames(2, np.zeros((5, 3, 40))), state(0, 1.0, 1.0, 5)
    frames.accept(field, field - 3.0, origin, 0.0)
    assert np.allclose(frames.next(np.full(field.shape, 7.0), origin + 1, 1.0), 10.0)


def test_only_judged_layers_count():
    """A layer that is not judged may be wild."""
    frames = TwoFrames(2, np.zeros((3, 3, 40)), [0, 2])
    for n in range(5):
        field, origin = state(n, 0.0, 1.0, 3)
        field = field.copy()
        field[1] += 1e6 * (-1) ** n
        if n:
            frames.next(0 * field, origin, float(n))
        frames.accept(field, 0 * field, origin, float(n))
    field, origin = state(5, 0.0, 1.0, 3)
    guess = frames.next(0 * field, origin, 5.0)
    assert np.allclose(guess[[0, 2], :, 6:-6], field[[0, 2], :, 6:-6], rtol=1e-6, atol=1e-4)
