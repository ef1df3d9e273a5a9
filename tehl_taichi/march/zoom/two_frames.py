"""Start values of a window's next state: extrapolated in the frame of the contact and in that of the feature, each trusted where
it was right one step ago (see :mod:`tehl_taichi.march.extrapolation`, which does the same on a grid at rest)."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.pressure.history import shift
from tehl_taichi.values.interpolation import lagrange

NOTHING = 1e-14  # squared error that is as good as none


@dataclass(frozen=True)
class WindowState:
    """A field (..., ny+1, nx+1) of the window with its first column `origin` and its feature `at` columns of the fine grid."""

    field: np.ndarray
    origin: int
    at: float


class TwoFrames:
    """The last states of a field in a window, and what comes next.

    order: highest order of extrapolation; resting(origin): the field of the start there, which does not move with a feature.
    """

    def __init__(self, order, resting):
        self.order, self.resting, self.states = order, resting, []
        self.made, self.missed = None, None

    def next(self, origin, at):
        """The guess for the state with the window from column `origin` on and the feature `at`. Raises IndexError before the
        first :meth:`accept`."""
        self.made = self._guesses(origin, at)
        if self.missed is None:
            return self.made[0]
        missed = [moved(one, self.states[0].origin - origin) for one in self.missed[: len(self.made)]]
        weights = [1.0 / (one + NOTHING) for one in missed]
        return sum(weight * guess for weight, guess in zip(weights, self.made)) / sum(weights)

    def accept(self, field, origin, at):
        """The newest state."""
        known = len(self.states) > self.order
        self.missed = [_nearby((guess - field) ** 2) for guess in self.made] if known and self.made else None
        self.states = [WindowState(field, origin, at), *self.states[: self.order]]

    def _guesses(self, origin, at):
        """Of order 1 up to the highest, in both frames; the newest state where there is but one."""
        count = len(self.states)
        still = [moved(one.field, one.origin - origin) for one in self.states]
        rests = self.resting(origin)
        moving = [rests + moved(one.field - self.resting(one.origin), at - one.at - (origin - one.origin))
                  for one in self.states]
        places = [one.at for one in self.states]
        weights = [lagrange(places[:states], at) for states in range(2, count + 1)] or [(1.0,)]
        return [sum(w * one for w, one in zip(weight, frame)) for weight in weights for frame in (moving, still)]


def moved(q, cells):
    """q (..., nx+1) moved by `cells` towards +x, what comes in as at the border."""
    back, weights = shift(cells)
    at, last = np.arange(q.shape[-1]), q.shape[-1] - 1
    return sum(weight * q[..., np.clip(at - back + k, 0, last)] for k, weight in enumerate(weights) if weight)


def _nearby(squares):
    """Summed over what lies before the last two axes, and over each node and its neighbours."""
    out = squares.reshape(-1, *squares.shape[-2:]).sum(axis=0)
    for axis in (0, 1):
        padded = np.pad(out, [(1, 1) if axis == n else (0, 0) for n in range(2)], mode="edge")
        out = sum(np.take(padded, np.arange(k, k + out.shape[axis]), axis) for k in range(3))
    return out
