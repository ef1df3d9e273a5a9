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

    order: highest order of extrapolation. start: the field of the steady start (..., ny+1, columns) on all fine columns.
    judged: layers of a field (layers, ny+1, nx+1) that show the errors of guesses (None: the whole field).
    """

    def __init__(self, order, start, judged=None):
        self.order, self.start, self.states, self.judged = order, start, [], judged
        self.made, self.missed = None, None

    def next(self, run, origin, at):
        """Guess the field for a window that begins at column `origin` with the feature at column `at`.

        run: the field of the run there. Raises IndexError before the first :meth:`accept`.
        """
        parts, guesses = self._parts(run, origin, at), self._guesses(at)
        shown = [self._shown(part) for part in parts]
        self.made = [_sum(shares, shown) for shares in guesses]
        if self.missed is None:
            return parts[0]
        weights = [1.0 / (carried(one, self.states[0].origin - origin) + NOTHING) for one in self.missed[: len(guesses)]]
        total = sum(weights)
        return _sum([_sum(shares, weights) / total for shares in zip(*guesses)], parts)

    def accept(self, field, run, origin, at):
        """Take `field` as the newest state; run: the field of the run there."""
        known, shown = len(self.states) > self.order, self._shown(field)
        self.missed = [_nearby((guess - shown) ** 2) for guess in self.made] if known and self.made else None
        newest = WindowState(field, field - self._rests(origin, field), field - run, origin, at)
        self.states = [newest, *self.states[: self.order]]

    def _shown(self, field):
        """The layers that show errors."""
        return field if self.judged is None else field[self.judged]

    def _rests(self, origin, like):
        """The field of the steady start in the window, shaped as `like`."""
        return self.start[..., origin : origin + like.shape[-1]]

    def _parts(self, run, origin, at):
        """List of fields: the run plus the last difference; the last states in the frame of the feature; and in that of the
        contact."""
        rests, ways = self._rests(origin, run), [(one, one.origin - origin) for one in self.states]
        finer = run + carried(self.states[0].finer, at - self.states[0].at + ways[0][1])
        moving = [rests + carried(one.passing, at - one.at + way) for one, way in ways]
        return [finer, *moving, *(carried(one.field, way) for one, way in ways)]

    def _guesses(self, at):
        """List of guesses, each a list of the shares of the parts: the first part; then extrapolations of order 1 to the
        highest in both frames (of order 0 if only one state is known)."""
        places = [one.at for one in self.states]
        none = [0.0] * len(places)
        out = [[1.0, *none, *none]]
        for count in range(2, len(places) + 1) if len(places) > 1 else [1]:
            shares = [*lagrange(places[:count], at), *none[count:]]
            out += [[0.0, *shares, *none], [0.0, *none, *shares]]
        return out


def _sum(weights, parts):
    """Sum of the parts times their weights (numbers or fields)."""
    return sum(weight * part for weight, part in zip(weights, parts) if np.any(weight))


def _nearby(squares):
    """Sums (ny+1, nx+1) of `squares` (..., ny+1, nx+1) over all but the last two axes, and over each node and its
    neighbours."""
    out = squares.reshape(-1, *squares.shape[-2:]).sum(axis=0)
    out = np.pad(out, 1, mode="edge")
    out = out[:-2] + out[1:-1] + out[2:]
    return out[:, :-2] + out[:, 1:-1] + out[:, 2:]
