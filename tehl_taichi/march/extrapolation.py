"""Prediction of the next step: extrapolations in time, each weighted by its accuracy in the last step.

Pressure changes caused by a feature move with it, those of the contact (outlet spike, inlet) stay. So a field is extrapolated
in the frame of the contact and in that of the feature. The better frame depends on the place and on the progress of the
passage, so every node takes the mean of all predictions, weighted by their errors for the newest state nearby.

Gear, isothermal, 256 columns, rms error of the predicted P/p_H with the asperity around -1.4 / -1 / -0.6 / -0.3 / 0.2 / 0.6 /
0.9 / 1.1 a: one frame up to -0.2 a and the other from there on 1e-4 / 1e-3 / 3e-4 / 4e-4 / 5e-3 / 5e-3 / 7e-3 / 7e-3; weighted
by place, order 1 8e-5 / 9e-4 / 1e-4 / 2e-5 / 2e-5 / 1e-3 / 3e-3 / 3e-3, orders 1 and 2 3e-5 / 5e-4 / 5e-5 / 7e-6 / 9e-6 / 1e-3
/ 3e-3 / 3e-3. Newton / Krylov per step with orders up to 1, 2, 3, 4: 2.85/17.9, 2.33/16.2, 2.32/15.1, 2.31/15.0.
"""

import numpy as np

from tehl_taichi.engine import runtime
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.simd import (
    Flat,
    L,
    LinearTable,
    Table,
    W,
    block_at,
    cells,
    columns_around,
    repeated,
    rows_around,
    tile,
    tiles,
)
from tehl_taichi.pressure.fields import MASK, P
from tehl_taichi.pressure.history import WAY, StateHistory, nodes, set_way, source
from tehl_taichi.values.interpolation import lagrange

WORK = 2  # of a column, in units of a copy
NOTHING = 1e-14  # squared error that is as good as none
START = 0  # row of the pressure of the start, where that shows what does not move
MADE = 1  # and of the first of 2 * order guesses, frame after frame; behind them squares of what they missed, and the states


@ti.func
def resting(F: ti.template(), at: ti.template(), edges: ti.template(), by_edge: ti.template(), state, i):
    """Value at column i of the part that does not move with the feature."""
    out = L(F, 0.0)
    if ti.static(by_edge):
        out += edges[state, i]
    else:
        out += F[START, at.q - at.i + i]
    return out


@ti.func
def with_feature(F: ti.template(), at: ti.template(), row, ways: ti.template(), edges: ti.template(), by_edge: ti.template(),
                 way):
    """State in a row after its moving part has moved."""
    out = resting(F, at, edges, by_edge, row, at.i)
    begin, end = nodes(ways, way)
    for m in range(begin, end):
        i = source(at.i, at.nx, ways, way, m)
        out += ti.cast(ways[way, m], F.dtype) * (F[row, at.q - at.i + i] - resting(F, at, edges, by_edge, row, i))
    return out


@ti.func
def predict(F: ti.template(), at: ti.template(), order: ti.template(), rows: ti.template(), ways: ti.template(),
            weights: ti.template(), edges: ti.template(), by_edge: ti.template()):
    """Store the predictions of a column: polynomials of degree 1 to `order` through the states in `rows`."""
    out = [L(F, 0.0) for _ in ti.static(range(2 * order))]
    for n in range(order + 1):
        row = int(rows[n])
        still, moving = F[row, at.q], with_feature(F, at, row, ways, edges, by_edge, n)
        for g in ti.static(range(order)):
            weight = ti.cast(weights[g, n], F.dtype)
            out[g] += weight * still
            out[order + g] += weight * moving
    for g in ti.static(range(2 * order)):
        F[MADE + g, at.q] = out[g]


@ti.func
def compare(S: ti.template(), F: ti.template(), at: ti.template(), order: ti.template(), row, edges: ti.template()):
    """Store the pressure of a column in `row`, and squared errors of the predictions for it, summed over neighbours along x."""
    there = [ti.min(ti.max(at.i + t, 0), at.nx) - at.i for t in ti.static(range(-1, 2))]
    pressed = [ti.cast(S[P, at.k + there[t]], F.dtype) for t in ti.static(range(3))]
    for g in range(2 * order):
        missed = L(F, 0.0)
        for t in ti.static(range(3)):
            miss = F[MADE + g, at.q + there[t]] - pressed[t]
            missed += miss * miss
        F[MADE + 2 * order + g, at.q] = missed
    newest = repeated(ti.cast(S[P, at.k], F.dtype), at.s, at.ny)
    F[row, at.q] = newest
    if at.s == at.ny // W:
        edges[row, at.i] = newest[W - 1]


@ti.func
def nearby(F: ti.template(), at: ti.template(), row):
    """Sum of a row over each node and its neighbours along y."""
    before, behind = columns_around(at, at.q)
    lower, upper = rows_around(at, F[row, at.q], F[row, before], F[row, behind])
    return lower + F[row, at.q] + upper


@ti.func
def combine(S: ti.template(), F: ti.template(), at: ti.template(), order: ti.template(), count: ti.template()):
    """Combine the first count[0] predictions of each frame to a pressure, with weights 1/(squared error)."""
    out, total = L(F, 0.0), L(F, 0.0)
    for g in ti.static(range(2 * order)):
        if g % order < int(count[0]):
            weight = L(F, 1.0) / (nearby(F, at, MADE + 2 * order + g) + L(F, NOTHING))
            out += weight * F[MADE + g, at.q]
            total += weight
    guess = ti.cast(ti.max(out / total, 0.0), ti.f64)
    S[P, at.k] = repeated(ti.select(S[MASK, at.k] > 0.0, guess, S[P, at.k]), at.s, at.ny)  # the border keeps its own


@ti.kernel
def extrapolate(F: ti.template(), G: Table, order: ti.template(), rows: Flat, ways: Table, weights: Table, edges: LinearTable,
                by_edge: ti.template(), alone: ti.template()):
    """See :func:`predict`."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        for i in range(first, last):
            at = block_at(G, c, i)
            predict(F, at, order, rows, ways, weights, edges, by_edge)


@ti.kernel
def judge(S: ti.template(), F: ti.template(), G: Table, order: ti.template(), rows: Flat, edges: LinearTable,
          alone: ti.template()):
    """See :func:`compare`; with the first of `rows`."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        row = int(rows[0])
        for i in range(first, last):
            at = block_at(G, c, i)
            compare(S, F, at, order, row, edges)


@ti.kernel
def trust(S: ti.template(), F: ti.template(), G: Table, order: ti.template(), count: Flat, alone: ti.template()):
    """See :func:`combine`."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1, serialize=alone)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        for i in range(first, last):
            at = block_at(G, c, i)
            combine(S, F, at, order, count)


class StateExtrapolation:
    """Last pressures of `levels`, and their extrapolation.

    order: highest order of extrapolation; the newest pressure is in the table; at: distance that the feature has moved, in
    cells (its speed is constant, so this is also the time); state: result of :meth:`state` to continue from, if it contains it.

    The outermost row of a line contact, which the feature does not reach, shows the resting part. A single row, and a point
    contact, whose pressure ends before that row, store their start instead. Newton steps with the outermost row and with the
    start: `furrow-line` 3.49, 3.01; a ridge 3.08, 2.51; `ridge-on-ball` on 64 columns 2.84, 2.67; `gear` on 128 2.64, 2.82.
    """

    def __init__(self, levels, order, at, state):
        self.levels, self.order = levels, order
        first = MADE + 4 * order
        self.past = StateHistory(levels, first + order + 2, "f32")
        self.rows = list(range(first, first + order + 2))  # the newest first; as many hold states as there are in `at`
        self.at = [float(where) for where in state.get("P_moved", [at])]
        self.made = None  # where the guesses in the table go to, if they are by order + 1 states
        newest = levels.get(P)
        self.by_edge = "P_start" not in state and levels.line and levels.ny > 0 and bool(newest[-1].any())
        self._bind()
        self._restore(state.get("P_history", newest[None]), state.get("P_start", newest))

    def _bind(self):
        v, F, order = self.levels, self.past.field, self.order
        self.places, self.ways, self.count = np.zeros(order + 1), np.zeros((order + 1, WAY)), np.zeros(1)
        self.weights, self.edges = np.zeros((order, order + 1)), np.zeros((self.rows[-1] + 1, v.nx + 1), np.float32)
        if runtime.by_cells():
            from tehl_taichi.march import cell_guess

            cell_guess.stand_in()
        self._extrapolate = v.launch(extrapolate, F, v.G, order, self.places, self.ways, self.weights, self.edges, self.by_edge,
                                     work=WORK)
        self._judge = v.launch(judge, v.S, F, v.G, order, self.places, self.edges, work=WORK)
        self._trust = v.launch(trust, v.S, F, v.G, order, self.count, work=WORK)

    def _restore(self, history, start):
        if not self.by_edge:
            self.past.put(START, start)
        for row, field in zip(self.rows[1:], history[1:]):  # the first one is in the table
            self.past.put(row, field)
            self.edges[row] = field[-1]
        newest, *self.rows = self.rows
        at, *self.at = self.at
        self.rows.append(newest)
        self.accept(at)

    def state(self):
        """Arrays to continue from: pressures, feature positions, and the start if it is stored."""
        start = {} if self.by_edge else {"P_start": self.past.get(START).astype(np.float32)}
        history = np.stack([self.past.get(row) for row in self.rows[: len(self.at)]]).astype(np.float32)
        return {"P_history": history, "P_moved": np.array(self.at), **start}

    def accept(self, at):
        """Take the pressure in the table as the newest state."""
        if self.at and self.made != at:  # the guesses that its first ones are judged by
            self._look(self.rows, self.at[: self.order + 1], at)
        self.count[0] = max(1, min(len(self.at), self.order + 1) - 1)
        self.rows = [self.rows[-1], *self.rows[:-1]]
        self.at, self.made = [at, *self.at[: self.order + 1]], None
        self.places[0] = self.rows[0]
        self._judge()

    def put(self, to):
        """Write the predicted pressure (not negative) for feature position `to` into the table; the first one is the newest
        state.
        """
        if len(self.at) == 1:
            newest, here = self.past.get(self.rows[0]), self.levels.get(P)
            self.levels.put(P, np.where(self.levels.get(MASK) > 0, newest, here))
            return
        self._look(self.rows, self.at[:-1], to)
        self.made = to if len(self.at) == self.order + 2 else None
        self._trust()

    def _look(self, rows, at, to):
        """Extrapolate the states in these rows, known at positions `at`, to the position `to`."""
        self.weights[:] = 0.0
        for n, (row, where) in enumerate(zip(rows, at)):
            self.places[n] = row
            set_way(self.ways[n], to - where)
        self.places[len(at):], self.ways[len(at):] = rows[0], self.ways[0]
        for g, states in enumerate(range(2, len(at) + 1) if len(at) > 1 else [1]):
            self.weights[g, :states] = lagrange(at[:states], to)
        self._extrapolate()


def extrapolated(values, at, to):
    """Value at `to` of the polynomial through the given values."""
    return float(sum(weight * value for weight, value in zip(lagrange(at[: len(values)], to), values)))
