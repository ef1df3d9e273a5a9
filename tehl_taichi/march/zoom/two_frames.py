"""Start values of the next state of a window, from several guesses.

Guesses are extrapolations in the frame of the contact and in the frame of the feature, and the run plus the last difference
between window and run. At each node a guess has the more weight the smaller its error was one step ago
(:mod:`tehl_taichi.march.extrapolation` does this on a grid at rest).
"""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.pressure.history import carried
from tehl_taichi.values.interpolation import lagrange

NOTHING = 1e-14  # squared errors below this count as zero


@dataclass(frozen=True)
class WindowState:
    """A field (..., ny+1, nx+1) of the window.

    passing: the field less that of the steady start; finer: the field less that of the run; origin: first fine column of the
    window; at: place of the feature, columns of the fine grid.
    """

    field: np.ndarray
    passing: np.ndarray
    finer: np.ndarray
    origin: int
    at: float


class TwoFrames:
    """The last states of a field in a window, and the guess of the next one.

    order: highest order of extrapolation; start: the field of the steady start (..., ny+1, columns) on all fine columns.
    """

    def __init__(self, order, start):
        self.order, self.start, self.states = order, start, []
        self.made, self.missed = None, None

    def next(self, run, origin, at):
        """Guess the field for a window that begins at column `origin` with the feature at column `at`.

        run: the field of the run there. Raises IndexError before the first :meth:`accept`.
        """
        self.made = self._guesses(run, origin, at)
        if self.missed is None:
            return self.made[0]
        missed = [carried(one, self.states[0].origin - origin) for one in self.missed[: len(self.made)]]
        weights = [1.0 / (one + NOTHING) for one in missed]
        return sum(weight * guess for weight, guess in zip(weights, self.made)) / sum(weights)

    def accept(self, field, run, origin, at):
        """Take `field` as the newest state; run: the field of the run there."""
        known = len(self.states) > self.order
        self.missed = [_nearby((guess - field) ** 2) for guess in self.made] if known and self.made else None
        newest = WindowState(field, field - self._rests(origin, field), field - run, origin, at)
        self.states = [newest, *self.states[: self.order]]

    def _rests(self, origin, like):
        """The field of the steady start in the window, shaped as `like`."""
        return self.start[..., origin : origin + like.shape[-1]]

    def _guesses(self, run, origin, at):
        """List of guesses: the run plus the last difference; then extrapolations of order 1 to the highest in both frames (of
        order 0 if only one state is known)."""
        rests, newest = self._rests(origin, run), self.states[0]
        back = [one.origin - origin for one in self.states]
        ride = [at - one.at + way for one, way in zip(self.states, back)]
        still = [carried(one.field, way) for one, way in zip(self.states, back)]
        moving = [carried(one.passing, way) for one, way in zip(self.states, ride)]
        places = [one.at for one in self.states]
        out = [run + carried(newest.finer, ride[0])]
        for count in range(2, len(places) + 1) if len(places) > 1 else [1]:
            weights = lagrange(places[:count], at)
            out += [rests + sum(w * one for w, one in zip(weights, moving)), sum(w * one for w, one in zip(weights, still))]
        return out


def _nearby(squares):
    """Sums (ny+1, nx+1) of `squares` (..., ny+1, nx+1) over all but the last two axes, and over each node and its
    neighbours."""
    out = squares.reshape(-1, *squares.shape[-2:]).sum(axis=0)
    out = np.pad(out, 1, mode="edge")
    out = out[:-2] + out[1:-1] + out[2:]
    return out[:, :-2] + out[:, 1:-1] + out[:, 2:]
