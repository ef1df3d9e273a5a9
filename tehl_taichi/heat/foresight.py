"""Start values of the next temperatures: extrapolated in time in the frame of the contact and in that of the feature, each
trusted where it was right one step ago (see :mod:`tehl_taichi.march.guess`, which does the same for the pressure)."""

import numpy as np

from tehl_taichi.engine.elementary import maximum, minimum
from tehl_taichi.engine.lanes import Flat, Table, V, W, cells, place, tile, tiles
from tehl_taichi.engine.language import ti
from tehl_taichi.engine.launches import bind
from tehl_taichi.engine.records import Record, read
from tehl_taichi.heat.film import keep_parts
from tehl_taichi.heat.slots import MOVING, STILL, TN, TNN, Fields, T, columns_around, rows_around
from tehl_taichi.pressure.storage import carried, shift

HOTTER = 20.0  # K, that a film is guessed to become than it was
NOTHING = 1e-14  # squared error that is as good as none
REACH = 6  # nodes of an interpolation along x
STATES = 3  # that must be known before differences in time count: the first of a start is none
EDGE, STAYS = 0, 1  # of the outermost row, (nz, nx+1): the next value, and what of it does not move with the feature


@ti.dataclass
class Ahead:
    """From the last two states to the next one."""

    slope: ti.f64  # of the last difference, so much goes on
    lowest: ti.f64  # deg C, that nothing is guessed below,
    highest: ti.f64  # or above


@ti.func
def shifted(Z: ti.template(), kind: ti.template(), at: ti.template(), nz, n, paths: ti.template(), path: ti.template()):
    """Values at node n moved by path number `path`; what comes in is as at the border."""
    moved, first = V(0.0), at.i - int(paths[path, REACH])
    for m in ti.static(range(REACH)):
        q = at.q - at.i + ti.min(ti.max(first + m, 0), at.nx)
        moved += paths[path, m] * Z[kind, q * nz + n]
    return moved


@ti.func
def extrapolated(Z: ti.template(), at: ti.template(), nz, n, paths: ti.template(), edges: ti.template(), slope):
    """The next values at node n, in the frame of the contact and in that of the feature."""
    q = at.q * nz + n
    still = Z[TN, q] + slope * (Z[TN, q] - Z[TNN, q])
    moved = (1.0 + slope) * shifted(Z, TN, at, nz, n, paths, 0) - slope * shifted(Z, TNN, at, nz, n, paths, 1)
    return still, moved + edges[STAYS, n, at.i]


@ti.func
def around(C: ti.template(), at: ti.template(), kind: ti.template()):
    """A single, summed over each node and its eight neighbours."""
    out = V(0.0)
    for t in ti.static(range(-1, 2)):
        q = at.q - at.i + ti.min(ti.max(at.i + t, 0), at.nx)
        before, behind = columns_around(at, q)
        lower, upper = rows_around(at, C[q, kind], C[before, kind], C[behind, kind])
        out += lower + C[q, kind] + upper
    return out


@ti.kernel
def judge(Z: ti.template(), C: ti.template(), G: Table, nz: ti.i32, numbers: Flat, paths: Table,
          edges: Fields):
    """STILL, MOVING: squares of what both would have missed the present temperatures by, at both walls and in the middle."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        ahead = read(Ahead, numbers)
        for i in range(first, last):
            at = place(G, c, i)
            missed_still, missed_moving = V(0.0), V(0.0)
            for third in range(3):
                n = third * (nz - 1) // 2
                still, moving = extrapolated(Z, at, nz, n, paths, edges, ahead.slope)
                missed_still += (still - Z[T, at.q * nz + n]) ** 2
                missed_moving += (moving - Z[T, at.q * nz + n]) ** 2
            C[at.q, STILL], C[at.q, MOVING] = missed_still, missed_moving


@ti.kernel
def foresee(Z: ti.template(), C: ti.template(), G: Table, nz: ti.i32, oil: ti.template(), numbers: Flat, paths: Table,
            edges: Fields):
    """Temperatures, and what of the viscosity depends on them alone; rows beyond the last one as this."""
    nx, ny, off = cells(G, 0)
    ti.loop_config(block_dim=1)
    for c in range(tiles(nx, ny)):
        s, first, last = tile(c, nx)
        ahead = read(Ahead, numbers)
        for i in range(first, last):
            at = place(G, c, i)
            missed_still, missed_moving = around(C, at, STILL) + NOTHING, around(C, at, MOVING) + NOTHING
            trust = missed_moving / (missed_still + missed_moving)  # in what stays: one over its error
            for n in range(nz):
                still, moving = extrapolated(Z, at, nz, n, paths, edges, ahead.slope)
                guess = moving + trust * (still - moving)
                for u in ti.static(range(W)):
                    guess[u] = ti.select(at.s * W + u <= at.ny, guess[u], edges[EDGE, n, i])
                Z[T, at.q * nz + n] = minimum(maximum(guess, ahead.lowest), ahead.highest)
            keep_parts(Z, at.q, nz, oil)


class Foresight:
    """Of the temperatures of `heat`, a :class:`tehl_taichi.heat.temperatures.FilmHeat`, from its last two states; at: how far
    the feature has moved in the last one, in cells; state: what :meth:`state` gave is gone on from, if it is in there."""

    KEYS = "T_moved", "T_missed"  # positions, newest first; (2, ny+1, nx+1)

    def __init__(self, heat, at, state):
        moved, missed = self.KEYS
        self.heat, self.at = heat, [at]
        if missed in state:
            self.at = [float(where) for where in state[moved]]
            heat.columns.singles.put(STILL, np.asarray(state[missed], float))
        self.edge_before = heat.columns.nodes(TNN)[:, -1]
        self.ahead, self.paths, self.edges = Record(Ahead), np.zeros((2, REACH + 1)), np.zeros((2, *self.edge_before.shape))
        film = (heat.columns.field, heat.columns.singles.field, heat.levels.G, heat.nz)
        known = self.ahead.values, self.paths, self.edges
        self._judge = bind(judge, *film, *known)
        self._foresee = bind(foresee, *film, heat.levels.scene.oil, *known)

    def put(self, to):
        """The guess for the state with the feature at `to` into the table; the first one is the newest state."""
        if len(self.at) > 1:
            self._look(to)
            self._foresee()

    def accept(self, at):
        """What is in the table is the newest state; to be told before the table's last states move on."""
        self._look(at)
        self._judge()
        self.at, self.edge_before = [at, *self.at[: STATES - 1]], self.heat.T[:, -1]

    def state(self):
        """Arrays to go on from."""
        return dict(zip(self.KEYS, (np.array(self.at), self.heat.columns.singles.get(STILL, 2))))

    def _look(self, to):
        """How the last states go on to `to`."""
        T, before = self.heat.T, self.at[min(1, len(self.at) - 1)]
        slope = (to - self.at[0]) / (self.at[0] - before) if len(self.at) == STATES else 0.0
        self.ahead.set(slope=slope, lowest=T.min(), highest=T.max() + HOTTER)
        rows, ways = (T[:, -1], self.edge_before), (to - self.at[0], to - before)
        for path, way in zip(self.paths, ways):
            path[REACH], path[:REACH] = shift(way)
        newest, last = rows
        moved, moved_last = (carried(row, way) for row, way in zip(rows, ways))
        self.edges[EDGE] = newest + slope * (newest - last)
        self.edges[STAYS] = self.edges[EDGE] - (moved + slope * (moved - moved_last))
