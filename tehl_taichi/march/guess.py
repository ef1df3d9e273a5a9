"""The guess for the next step: extrapolations in time, each trusted where it was right one step ago.

What a feature does to the pressure moves with it, what the contact does (its outlet spike, its inlet) stays: a field is
extrapolated in the frame of the contact and in that of the feature. Which one is right differs from place to place and along
the passage, so every node takes the mean of all guesses, weighted by how they would have guessed the newest state nearby.

Gear, isothermal, 256 columns, rms error of the guessed P/p_H with the asperity around -1.4 / -1 / -0.6 / -0.3 / 0.2 / 0.6 /
0.9 / 1.1 a: one frame up to -0.2 a and the other from there on 1e-4 / 1e-3 / 3e-4 / 4e-4 / 5e-3 / 5e-3 / 7e-3 / 7e-3; trusted
by place, order 1 8e-5 / 9e-4 / 1e-4 / 2e-5 / 2e-5 / 1e-3 / 3e-3 / 3e-3, orders 1 and 2 3e-5 / 5e-4 / 5e-5 / 7e-6 / 9e-6 / 1e-3
/ 3e-3 / 3e-3. Newton / Krylov per step with orders up to 1, 2, 3, 4: 2.85/17.9, 2.33/16.2, 2.32/15.1, 2.31/15.0.
"""

import numpy as np

from tehl_taichi.pressure.storage import carried, lagrange

NOTHING = 1e-14  # squared error that is as good as none


class Guess:
    """The last pressures (ny+1, nx+1) and what comes next.

    order: highest order of extrapolation; P: the newest; at: how far the feature has moved, in cells (it moves at a constant
    speed, so this is the time, too); state: what :meth:`state` gave is gone on from, if it is in there.

    What does not move is told by the outermost row of a line contact, which knows nothing of the feature. A single row, and a
    point contact, whose pressure ends before that row, remember their start instead. Newton steps by the outermost row and by
    the start: `furrow-line` 3.49, 3.01; a ridge 3.08, 2.51; `ridge-on-ball` on 64 columns 2.84, 2.67; `gear` on 128 2.64, 2.82.
    """

    def __init__(self, order, P, at, state):
        self.length = order + 2
        self.fields = list(state.get("P_history", [_single(P)]))  # newest first
        self.at = [float(where) for where in state.get("P_moved", [at])]
        self.start = None if len(P) > 1 and P[-1].any() else state.get("P_start", _single(P))
        self.made = None, []  # where to, and the extrapolations of the last guess

    def state(self):
        """Arrays to go on from: the pressures, where the feature was, and the start where it is remembered."""
        start = {} if self.start is None else {"P_start": self.start}
        return {"P_history": np.stack(self.fields), "P_moved": np.array(self.at), **start}

    def accept(self, field, at):
        """`field` is the newest state."""
        self.fields, self.at = [_single(field), *self.fields[: self.length - 1]], [at, *self.at[: self.length - 1]]

    def next(self, at):
        """The guess for the state with the feature at `at`."""
        newest = self.fields[0]
        if len(self.fields) == 1:
            return newest
        trusts = self._trusts()
        guesses = list(self._extrapolations(self.fields[:-1], self.at[:-1], at))
        self.made = at if len(self.fields) == self.length else None, guesses
        return sum(trust * guess for trust, guess in zip(trusts, guesses)) / sum(trusts)

    def _trusts(self):
        """Weight of each extrapolation at each node: one over the square of what it would have missed."""
        newest, *known = self.fields
        made, past = self.made
        if made != self.at[0]:  # else they are those of the last guess, which went to this place by the same states
            past = self._extrapolations(known, self.at[1:], self.at[0])
        return [1 / (_nearby((before - newest) ** 2) + NOTHING) for before in past]

    def _extrapolations(self, fields, at, to):
        """The field at `to` by polynomials of degree 1, 2, ... through the newest states (Newton's divided differences), in the
        frame of the contact and then in that of the feature; as it is if there is but one."""
        for moving in (0.0, 1.0):
            slopes, power = [self._moved(field, moving * (to - where)) for field, where in zip(fields, at)], 1.0
            guess = slopes[0]
            if len(at) == 1:
                yield guess
            for k in range(1, len(at)):
                slopes = [(a - b) / (at[j] - at[j + k]) for j, (a, b) in enumerate(zip(slopes, slopes[1:]))]
                power *= to - at[k - 1]
                guess = guess + power * slopes[0]
                yield guess

    def _moved(self, field, cells):
        """What differs from the outermost row, or from the start, moved by `cells`."""
        resting = field[-1:] if self.start is None else self.start
        return resting + carried(field - resting, cells) if cells else field


def _single(field):
    return field.astype(np.float32)


def extrapolated(values, at, to):
    """The number at `to` by the polynomial through the given ones."""
    return float(sum(weight * value for weight, value in zip(lagrange(at[: len(values)], to), values)))


def _nearby(squares):
    """(ny+1, nx+1), summed over each node and its eight neighbours."""
    out = squares.copy()
    for axis in (0, 1):
        middle, ahead, behind = out.copy(), [slice(None)] * 2, [slice(None)] * 2
        ahead[axis], behind[axis] = slice(1, None), slice(None, -1)
        out[tuple(ahead)] += middle[tuple(behind)]
        out[tuple(behind)] += middle[tuple(ahead)]
    return out
