"""The storage term d(rho H)/dT of the Reynolds equation: backward differences along the path of the oil.

In the contact rho H is carried by the oil, unchanged, and a feature that rolls with the oil stands still in its frame: along
the paths little happens in a step, while at rest a whole feature passes. What passes at rest is kept apart: the Couette flow
of the smooth contact (rho H of the start) stays third-order upwind, only what differs from it is followed along the paths.

Film under the 1.5 um asperity of the gear at X = 0 on 128 / 256 / 512 columns (limit 0.142): BDF2 at rest 0.146 / 0.140 /
0.142, its pattern 6 % too slow on 256 columns; along the paths BDF2 0.126 / 0.138 / 0.141, BDF3 0.131 / 0.139 (with the same
mobilities). Steps of half a cell: with cubic interpolation -1.2 %, with this one +0.5 %, p_max +0.01 %.
"""

import functools
import math

import numpy as np

from tehl_taichi.pressure import fields
from tehl_taichi.pressure.couette import FIRST, UPWIND

LONGEST_PATH = 2.0  # cells of a step; beyond, the frame moves slower than the oil
STABLE_AT_REST = 0.5  # cells of a step that the oil may move in that frame with third-order differences
ORDER = 3
WHOLE = 1e-9  # cells
# Of the node-to-node wave on the way of a cell, where paths are of whole cells and nothing else damps it. furrow-line (two
# cells a step), largest ripple of the pressure over the passage / with the furrow at -0.5 a, MPa: as it is 37/35, paths of at
# most 1.95 / 1.9 cells 31/21 / 30/13, filters by the fourth difference (0.5 of a path) 8/0.2, the sixth (0.5) 9/0.2, the
# eighth (0.2) 27/8, (0.5) 10/0.2, (1) 6/0.2; film under the asperity of pitch-line on 128 columns (one cell a step), um: as
# it is 0.1308, fourth 0.1283, sixth 0.1276, eighth 0.1309, 0.1303, 0.1287. The furrow's film does not change (0.1970). The
# eighth with 0.5 of each cell: 7 on 256 columns, 17 on 128 (0.5 of a path 21), 45 at the exit of 512 (57), and the asperity's
# film stays 0.1303
DAMPING = 0.5
EIGHTH = 256  # eighth difference of the wave (-1)^i
STEADY = 1e-6  # relative; third-order differences need steps of equal length


@functools.lru_cache(maxsize=16)  # nearly all steps have one length
def bdf(*lengths):
    """(rate, weights): df/dt is rate (f - sum of weights times the values before), by the polynomial through them.

    lengths: this step's, that of the step before, ... (one more value each).
    """
    t = -np.concatenate([[0.0], np.cumsum(lengths)])
    rate, weights = -np.sum(1 / t[1:]), []
    for j in range(1, t.size):
        other = np.delete(t, j)
        weights.append(-np.prod(-other[1:]) / np.prod(t[j] - other) / rate)
    return rate, np.array(weights)


def carried(q, cells):
    """q (..., nx+1) moved by `cells` towards +x: interpolation between six nodes, what comes in is as at the border."""
    (back, weights), n = shift(cells), q.shape[-1]
    padded = np.empty((*q.shape[:-1], n + back + 2), q.dtype)
    padded[..., :back], padded[..., back : back + n], padded[..., back + n :] = q[..., :1], q, q[..., -1:]
    if 1.0 in weights:
        return padded[..., 3 : 3 + n]
    out, term = np.zeros_like(q), np.empty_like(q)
    for k, weight in enumerate(weights):
        out += np.multiply(padded[..., k : k + n], weight, out=term)
    return out


def shift(cells):
    """(back, weights) of what is moved by `cells` towards +x: at node i the sum of weights[k] times the value at i - back + k.
    Whole cells have a single weight, 1."""
    whole = math.floor(cells + WHOLE)
    part = cells - whole
    return whole + 3, _weights(0.0 if part < WHOLE else part)


def followed(fields, cells):
    """Sum of the fields (..., nx+1), each :func:`carried` by so many cells, over and over again: each whole cell, which no
    interpolation smooths, takes DAMPING of the shortest wave."""
    moved = [carried(q, path) for q, path in zip(fields, cells)]
    out = sum(moved)
    if any(map(_lost, cells)):
        out[..., 4:-4] -= np.diff(sum(_lost(path) * q for path, q in zip(cells, moved)), 8) / EIGHTH
    return out


def _lost(cells):
    """Share of the shortest wave that is taken out on the way of so many cells."""
    return 1 - (1 - DAMPING) ** round(cells) if abs(cells - round(cells)) < WHOLE else 0.0


@functools.lru_cache(maxsize=16)
def _weights(part):
    """Of the nodes -3 ... 2 for the value at -part."""
    return lagrange(range(-3, 3), -part)


def lagrange(at, to):
    """Weights of the values at the places `at` for the value at `to`, by the polynomial through them."""
    return [math.prod((to - b) / (a - b) for b in at if b != a) for a in at]


def third_order(q):
    """dx dq/dX of q (..., nx+1) by the Couette stencil of the Reynolds equation; 0 in the border columns."""
    out, last = np.zeros_like(q), q.shape[-1] - 1
    for t, (weight, first) in enumerate(zip(UPWIND, FIRST)):
        out[..., 2:-1] += weight * q[..., t : last - 2 + t]
        out[..., 1] += first * q[..., max(t - 1, 0)]
    return out


class Storage:
    """rho H of the start and of the last steps on `levels`; state: what :meth:`state` gave, or None for the table's."""

    def __init__(self, levels, state=None):
        self.levels = levels
        self.start, *self.old = [self._now()] * 2 if state is None else state["mass"]
        self.lengths = [] if state is None else list(state["lengths"])
        self.couette = third_order(self.start)

    def centre(self):
        """What counts as resting is the newest state from here on: one that does not change any more is then steady."""
        self.start = self.old[0]
        self.couette = third_order(self.start)

    def state(self):
        """Arrays to go on from: mass (start, newest, ...), lengths of the steps between the latter."""
        return {"mass": np.stack([self.start, *self.old]), "lengths": np.array(self.lengths)}

    def begin(self, dT):
        """Rate, frame and old levels of the storage term for a step of dT."""
        v, length = self.levels, dT / self.levels.dx
        frame = min(1.0, LONGEST_PATH / length)
        lengths = [dT, *self.lengths[: self._order(dT, (1 - frame) * length) - 1]]
        rate, weights = bdf(*lengths)
        differences = [weight * (q - self.start) for weight, q in zip(weights, self.old)]
        old = self.start + followed(differences, frame * np.cumsum(lengths) / v.dx)
        v.numbers.set_rate(rate, frame)
        v.put(fields.QOLD, frame * self.couette - rate * v.dx * old)

    def _order(self, dT, at_rest):
        equal = all(abs(length - dT) <= STEADY * dT for length in self.lengths[: ORDER - 1])
        steady = equal and at_rest < STABLE_AT_REST
        return min(ORDER if steady else 2, len(self.old))

    def accept(self, dT):
        """The state in the table is the next one, dT after the last."""
        self.old, self.lengths = [self._now(), *self.old[: ORDER - 1]], [dT, *self.lengths[: ORDER - 2]]

    def _now(self):
        return self.levels.get(fields.RHO) * self.levels.get(fields.H)
