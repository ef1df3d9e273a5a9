"""Prediction of the next temperatures: extrapolated in the frames of the contact and of the feature, weighted by their errors
in the last step (see :mod:`tehl_taichi.march.extrapolation`, which predicts the pressure).
"""

import numpy as np

from tehl_taichi.engine.elementary import maximum, minimum
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.records import Record, read
from tehl_taichi.engine.simd import Flat, Table, V, block_at, cells, columns_around, repeated, rows_around, tile, tiles
from tehl_taichi.engine.taichi_patches.prebound import bind
from tehl_taichi.heat.film import keep_parts
from tehl_taichi.heat.film_tables import MOVING, STILL, TN, TNN, T
from tehl_taichi.pressure.history import WAY, carried, moved, set_way

HOTTER = 20.0  # K, that a film is guessed to become than it was
NOTHING = 1e-14  # squared error that is as good as none
STATES = 3  # that must be known before differences in time count: the first of a start is none


@ti.dataclass
class Trend:
    """Extrapolation from the last two states to the next one."""

    slope: ti.f64  # of the last difference, so much continues
    lowest: ti.f64  # deg C, that nothing is guessed below,
    highest: ti.f64  # or above


@ti.func
def extrapolated(Z: ti.template(), at: ti.template(), nz, n, paths: ti.template(), stays: ti.template(), slope):
    """Predicted values at node n in the frames of the contact and of the feature; stays (nz, nx+1): part that does not move
    with it.
    """
    q = at.q * nz + n
    still = Z[TN, q] + slope * (Z[TN, q] - Z[TNN, q])
    newest = moved(Z, TN, at.q - at.i, at.i, at.nx, paths, 0, nz, n)
    last = moved(Z, TNN, at.q - at.i, at.i, at.nx, paths, 1, nz, n)
    return still, (1.0 + slope) * newest - slope * last + stays[n, at.i]


@ti.func
def around(C: ti.template(), at: ti.template(), kind: ti.template()):
    """Sum of a quantity over each node and its eight neighbours."""
    out = V(0.0)
    for t in ti.static(range(-1, 2)):
        q = at.q - at.i + ti.min(ti.max(at.i + t, 0), at.nx)
        before, behind = columns_around(at, q)
        lower, upper = rows_around(at, C[q, kind], C[before, kind], C[behind, kind])
        out += lower + C[q, kind] + upper
    return out


@ti.kernel
def judge(Z: ti.template(), C: ti.template(), G: Table, nz: ti.i32, numbers: Flat, paths: Table, stays: Table):
    """Compute STILL, MOVING: squared errors of both predictions for the present temperatures, at both walls and in the
    middle.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        ahead = read(Trend, numbers)
        for i in range(first, last):
            at = block_at(G, c, i)
            missed_still, missed_moving = V(0.0), V(0.0)
            for third in range(3):
                n = third * (nz - 1) // 2
                still, moving = extrapolated(Z, at, nz, n, paths, stays, ahead.slope)
                missed_still += (still - Z[T, at.q * nz + n]) ** 2
                missed_moving += (moving - Z[T, at.q * nz + n]) ** 2
            C[at.q, STILL], C[at.q, MOVING] = missed_still, missed_moving


@ti.kernel
def foresee(Z: ti.template(), C: ti.template(), G: Table, nz: ti.i32, oil: ti.template(), numbers: Flat, paths: Table,
            stays: Table):
    """Write the predicted temperatures, and the viscosity terms that depend only on them; rows beyond the last one repeat
    it.
    """
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        ahead = read(Trend, numbers)
        for i in range(first, last):
            at = block_at(G, c, i)
            missed_still, missed_moving = around(C, at, STILL) + NOTHING, around(C, at, MOVING) + NOTHING
            trust = missed_moving / (missed_still + missed_moving)  # in what stays: one over its error
            for n in range(nz):
                still, moving = extrapolated(Z, at, nz, n, paths, stays, ahead.slope)
                guess = moving + trust * (still - moving)
                Z[T, at.q * nz + n] = minimum(maximum(repeated(guess, at.s, at.ny), ahead.lowest), ahead.highest)
            keep_parts(Z, at.q, nz, oil)


class TemperatureExtrapolation:
    """Extrapolation of the temperatures of `heat`, a :class:`tehl_taichi.heat.temperatures.FilmHeat`, from its last two states.

    at: displacement of the feature in the last one, in cells; state: result of :meth:`state` to continue from, if it contains
    it.
    """

    def __init__(self, heat, at, state):
        self.heat, self.at, self.edge_before = heat, [at], heat.columns.nodes(TNN)[:, -1]
        if "T_missed" in state:
            self.at = [float(where) for where in state["T_moved"]]  # newest first
            heat.columns.singles.put(STILL, np.asarray(state["T_missed"], float))
        self.start = state.get("T_start", heat.T[:, 0]) if heat.levels.ny == 0 else None
        self.ahead, self.paths, self.stays = Record(Trend), np.zeros((2, WAY)), np.zeros(self.edge_before.shape)
        film = (heat.columns.field, heat.columns.singles.field, heat.levels.G, heat.nz)
        known = self.ahead.values, self.paths, self.stays
        self._judge = bind(judge, *film, *known)
        self._foresee = bind(foresee, *film, heat.levels.scene.oil, *known)

    def put(self, to):
        """Write the prediction for feature position `to` into the table, over the result of any failed attempt; the first one
        is the newest state.
        """
        if len(self.at) == 1:
            self.heat.set_temperature(self.heat.T)
            return
        self._look(to)
        self.ahead.set(lowest=self.heat.T.min(), highest=self.heat.T.max() + HOTTER)
        self._foresee()

    def accept(self, at):
        """Take the state in the table as the newest; call it before the table's last states are shifted."""
        self._look(at)
        self._judge()
        self.at, self.edge_before = [at, *self.at[: STATES - 1]], self.heat.T[:, -1]

    def state(self):
        """Arrays to continue from: feature positions, squared errors (2, ny+1, nx+1), the start."""
        start = {} if self.start is None else {"T_start": self.start}
        return {"T_moved": np.array(self.at), "T_missed": self.heat.columns.singles.get(STILL, 2), **start}

    def _look(self, to):
        """Trend from the last states to feature position `to`."""
        T, before = self.heat.T, self.at[min(1, len(self.at) - 1)]
        slope = (to - self.at[0]) / (self.at[0] - before) if len(self.at) == STATES else 0.0
        self.ahead.set(slope=slope)
        ways = to - self.at[0], to - before
        for path, way in zip(self.paths, ways):
            set_way(path, way)
        rests = (T[:, -1], self.edge_before) if self.start is None else (self.start, self.start)
        newest, last = (row - carried(row, way) for row, way in zip(rests, ways))
        self.stays[:] = newest + slope * (newest - last)
