"""Storage term d(rho H)/dT of the Reynolds equation: backward differences along the path of the oil.

In the contact the oil carries rho H unchanged, and a feature that rolls with the oil is at rest in the oil's frame. So along
the paths little changes in a step, while at a fixed place a whole feature passes. The resting part is separate: the Couette
flow of the smooth contact (rho H of the start) stays third-order upwind; only the difference from it is followed along the
paths.

Film under the 1.5 um asperity of the gear at X = 0 on 128 / 256 / 512 columns (limit 0.142): BDF2 at rest 0.146 / 0.140 /
0.142, its pattern 6 % too slow on 256 columns; along the paths BDF2 0.126 / 0.138 / 0.141, BDF3 0.131 / 0.139 (with equal
mobilities). Steps of half a cell: with cubic interpolation -1.2 %, with this one +0.5 %, p_max +0.01 %.
"""

import functools
import itertools
import math

import numpy as np

from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import Record, read
from tehl_taichi.engine.simd import Flat, L, Table, W, cells, repeated
from tehl_taichi.pressure.fields import QOLD, RHO, H
from tehl_taichi.pressure.history import WAY, WHOLE, StateHistory, nodes, set_way, source
from tehl_taichi.pressure.upwind import FIRST, UPWIND

LONGEST_PATH = 2.0  # cells of a step; beyond, the frame moves slower than the oil
STABLE_AT_REST = 0.5  # cells of a step that the oil may move in that frame with third-order differences
ORDER = 3
# of the node-to-node wave on the way of a cell, where paths are of whole cells and nothing else damps it (docs/decisions/18)
DAMPING = 0.5
EIGHTH = tuple((-1.0) ** m * math.comb(8, m) / 256 for m in range(9))  # eighth difference, of the wave (-1)^i the wave
FOLLOWING = 2  # work of a column, in units of a copy
STEADY = 1e-6  # relative; third-order differences need steps of equal length


@functools.lru_cache(maxsize=16)  # nearly all steps have one length
def bdf(*lengths):
    """(rate, weights): df/dt is rate (f - sum of weights times earlier values), by the polynomial through them.

    lengths: of this step, the last one, ... (one value more for each).
    """
    t = -np.concatenate([[0.0], np.cumsum(lengths)])
    rate, weights = -np.sum(1 / t[1:]), []
    for j in range(1, t.size):
        other = np.delete(t, j)
        weights.append(-np.prod(-other[1:]) / np.prod(t[j] - other) / rate)
    return rate, np.array(weights)


def _lost(cells):
    """Share of the shortest wave that is damped during a move by `cells`."""
    return 1 - (1 - DAMPING) ** round(cells) if abs(cells - round(cells)) < WHOLE else 0.0


def third_order(q):
    """Difference dx dq/dX of q (..., nx+1) by the Couette stencil of the Reynolds equation; 0 in the border columns."""
    out, last = np.zeros_like(q), q.shape[-1] - 1
    for t, (weight, first) in enumerate(zip(UPWIND, FIRST)):
        out[..., 2:-1] += weight * q[..., t : last - 2 + t]
        out[..., 1] += first * q[..., max(t - 1, 0)]
    return out


_row = itertools.count()
START, COUETTE, LOST = (next(_row) for _ in range(3))  # rows: rho H that counts as resting, dx d/dX of it, what is damped
OLD = [next(_row) for _ in range(ORDER)]  # and of the last steps
ROW, SHARE = range(2)  # columns of an old state: its row, share of the shortest wave that is lost on its way


@ti.dataclass
class Frame:
    """Frame of reference in which the old states are followed."""

    states: ti.f64  # number of those that count
    speed: ti.f64  # of the oil's
    rate: ti.f64  # times dx
    damped: ti.f64  # 1 where a path is of whole cells


@ti.func
def differences(O: ti.template(), first, i, nx, states: ti.template(), ways: ti.template(), count):
    """Differences from the resting state along the paths: (their sum, the sum without its shortest wave)."""
    out, lost = L(O, 0.0), L(O, 0.0)
    for n in range(count):
        row = int(states[n, ROW])
        begin, end = nodes(ways, n)
        followed = L(O, 0.0)
        for m in range(begin, end):
            q = first + source(i, nx, ways, n, m)
            followed += ways[n, m] * (O[row, q] - O[START, q])
        out += followed
        lost += states[n, SHARE] * followed
    return out, lost


@ti.func
def eighth(O: ti.template(), q):
    """Shortest wave of LOST in column q."""
    out = L(O, 0.0)
    for m in ti.static(range(9)):
        out += ti.static(EIGHTH[m]) * O[LOST, q - 4 + m]
    return out


@ti.kernel
def follow(S: ti.template(), O: ti.template(), G: Table, numbers: Flat, states: Table, ways: Table, alone: ti.template()):
    """Compute QOLD from the old states."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        frame, first = read(Frame, numbers), s * (nx + 1)
        for i in range(nx + 1):
            out, lost = differences(O, first, i, nx, states, ways, int(frame.states))
            old = O[START, first + i] + out
            S[QOLD, off + first + i] = frame.speed * O[COUETTE, first + i] - frame.rate * old
            O[LOST, first + i] = lost
        if frame.damped > 0.0:
            for i in range(4, nx - 3):
                k = off + first + i
                S[QOLD, k] = S[QOLD, k] + frame.rate * eighth(O, first + i)


@ti.kernel
def keep(S: ti.template(), O: ti.template(), G: Table, row: Flat, alone: ti.template()):
    """Set O[row[0]] = rho H of the present state."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for s in range(ny // W + 1):
        for i in range(nx + 1):
            q = s * (nx + 1) + i
            O[int(row[0]), q] = repeated(S[RHO, off + q] * S[H, off + q], s, ny)


class Storage:
    """Values rho H of the start and of the last steps on `levels`; state: result of :meth:`state`, or None for the state in the
    table.
    """

    def __init__(self, levels, state=None):
        self.levels, self.past = levels, StateHistory(levels, len((START, COUETTE, LOST, *OLD)))
        self.old, self.known, self.lengths = list(OLD), 0, []  # rows, the newest first: the first `known` of them hold states
        self._bind()
        if state is None:
            self._keep_newest()
            self.centre()
        else:
            self._restore(state)

    def _bind(self):
        v = self.levels
        self.frame, self.newest = Record(Frame), np.zeros(1)
        self.states, self.ways = np.zeros((ORDER, SHARE + 1)), np.zeros((ORDER, WAY))
        self._keep = v.launch(keep, v.S, self.past.field, v.G, self.newest)
        self._follow = v.launch(follow, v.S, self.past.field, v.G, self.frame.values, self.states, self.ways, work=FOLLOWING)

    def _restore(self, state):
        start, *old = state["mass"]
        self.replace(start, old)
        self.lengths = list(state["lengths"])

    def centre(self):
        """Take the newest state as the resting one: a state that no longer changes is then exactly steady."""
        self._rest(self.past.get(self.old[0]))

    def _rest(self, start):
        self.past.put(START, start)
        self.past.put(COUETTE, third_order(start))

    def replace(self, start, old):
        """Replace rho H by `start` at rest and `old` in the last steps, the newest first, for a grid that has moved."""
        self._rest(start)
        self.known = len(old)
        for row, q in zip(self.old, old):
            self.past.put(row, q)

    def state(self):
        """Arrays to continue from: mass (start, newest, ...), lengths of the steps between the latter."""
        rows = START, *self.old[: self.known]
        return {"mass": np.stack([self.past.get(row) for row in rows]), "lengths": np.array(self.lengths)}

    def begin(self, dT):
        """Set rate, frame and old levels of the storage term for a step of dT."""
        v, length = self.levels, dT / self.levels.dx
        speed = min(1.0, LONGEST_PATH / length)
        lengths = [dT, *self.lengths[: self._order(dT, (1 - speed) * length) - 1]]
        rate, weights = bdf(*lengths)
        paths = speed * np.cumsum(lengths) / v.dx
        for n, (weight, path) in enumerate(zip(weights, paths)):
            self.states[n] = self.old[n], _lost(path)
            set_way(self.ways[n], path, weight)
        self.frame.set(states=len(lengths), speed=speed, rate=rate * v.dx, damped=self.states[: len(lengths), SHARE].any())
        v.numbers.set_rate(rate, speed)
        self._follow()

    def _order(self, dT, at_rest):
        equal = all(abs(length - dT) <= STEADY * dT for length in self.lengths[: ORDER - 1])
        steady = equal and at_rest < STABLE_AT_REST
        return min(ORDER if steady else 2, self.known)

    def accept(self, dT):
        """Take the state in the table as the next one, dT after the last."""
        self._keep_newest()
        self.lengths = [dT, *self.lengths[: ORDER - 2]]

    def _keep_newest(self):
        self.newest[0] = self.old.pop()
        self._keep()
        self.old.insert(0, int(self.newest[0]))
        self.known = min(self.known + 1, ORDER)
