"""Start values of a window's next state: extrapolated in the frame of the contact and in that of the feature, and by what the
window differed from the run, each trusted where it was right one step ago (see :mod:`tehl_taichi.march.extrapolation`, which
does the same on a grid at rest)."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.pressure.history import carried
from tehl_taichi.values.interpolation import lagrange

NOTHING = 1e-14  # squared error that is as good as none


@dataclass(frozen=True)
class WindowState:
    """A field (..., ny+1, nx+1) of the window, less that of the start (`passing`) and less that of the run (`finer`); its first
    column `origin`, and its feature `at` columns of the fine grid."""

    field: np.ndarray
    passing: np.ndarray
    finer: np.ndarray
    origin: int
    at: float


class TwoFrames:
    """The last states of a field in a window, and what comes next.

    order: highest order of extrapolation; start: the field of the start (..., ny+1, columns) on all columns of the fine grid,
    which does not move with a feature.
    """

    def __init__(self, order, start):
        self.order, self.start, self.states = order, start, []
        self.made, self.missed = None, None

    def next(self, run, origin, at):
        """The guess for the state with the window from column `origin` on and the feature `at`; run: the field of the run
        there. Raises IndexError before the first :meth:`accept`."""
        self.made = self._guesses(run, origin, at)
        if self.missed is None:
            return self.made[0]
        missed = [carried(one, self.states[0].origin - origin) for one in self.missed[: len(self.made)]]
        weights = [1.0 / (one + NOTHING) for one in missed]
        return sum(weight * guess for weight, guess in zip(weights, self.made)) / sum(weights)

    def accept(self, field, run, origin, at):
        """The newest state; run: the field of the run there."""
        known = len(self.states) > self.order
        self.missed = [_nearby((guess - field) ** 2) for guess in self.made] if known and self.made else None
        newest = WindowState(field, field - self._rests(origin, field), field - run, origin, at)
        self.states = [newest, *self.states[: self.order]]

    def _rests(self, origin, like):
        return self.start[..., origin : origin + like.shape[-1]]

    def _guesses(self, run, origin, at):
        """The run with the last difference; of order 1 up to the highest, in both frames, or the newest state where it is the
        only one."""
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
    """Summed over what lies before the last two axes, and over each node and its neighbours."""
    out = squares.reshape(-1, *squares.shape[-2:]).sum(axis=0)
    out = np.pad(out, 1, mode="edge")
    out = out[:-2] + out[1:-1] + out[2:]
    return out[:, :-2] + out[:, 1:-1] + out[:, 2:]
