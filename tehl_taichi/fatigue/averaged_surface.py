"""Averages of the surface's stress histories over a length, and the worst of them.

Points keep their distances, so the history of an averaged stress is the average of the histories of the points around. It is
computed and searched only where it may be the worst. The value of a criterion is convex in the stress history: the radius of
the smallest circle around a sum of shear paths is at most the sum of their radii, the largest normal stress of a sum at most
the sum of the largest ones. So the value of an averaged stress is at most the average of the values at points.
"""

import numpy as np

from tehl_taichi.fatigue import findley
from tehl_taichi.fatigue.layer import Layer
from tehl_taichi.fatigue.stress.averaging import is_mirrored, weights
from tehl_taichi.fatigue.stress.half_space import COMPONENTS, ODD
from tehl_taichi.fatigue.worst_point import CLOSE, close_ones, worse
from tehl_taichi.laws.criteria import CRITERIA

LOW = 1.03  # first planes are so much too low (`NEAR` of findley.py)
AT_ONCE = 128  # points that are searched together, those with the largest bounds first


class AveragedSurface:
    """Search of the stresses at the surface, averaged over a square of `length` (m) parallel to it: :meth:`add` takes the
    histories of all rows, block by block; `layer` is the result.

    passage: StressHistories of the points. Beyond their ends stresses are constant, or mirrored about y = 0.
    """

    def __init__(self, passage, length):
        self.passage, self.local, self.done = passage, passage.strength.at(0.0), 0
        y = passage.reader.y
        self.mirrored = is_mirrored(passage.reader) and passage.rows.start == 0
        self.parts = [list(enumerate(part, -(part.size // 2))) for part in (
            weights(length, passage.dx), weights(length, float(y[1] - y[0])) if len(y) > 1 else np.ones(1))]
        self.reach = len(self.parts[1]) // 2
        self.f = np.full((passage.x.size, passage.y.size), -np.inf)
        self.worst, self.close, self.tail = None, [], None

    @property
    def layer(self):
        """The :class:`tehl_taichi.fatigue.layer.Layer` of averaged stresses; f: -inf at points that cannot be the worst."""
        none = np.full_like(self.f, np.nan)
        return Layer(0.0, self.f, none, none, none, none, self.worst, None, None, self.close)

    def add(self, rows, history, f):
        """Search the rows whose neighbours are known.

        rows: slice of the rows of this block; history: (points, moments, 6) Pa; f: (points,) values at these points, Pa.
        """
        shape, reach = (self.passage.x.size, rows.stop - rows.start), self.reach
        block = Rows(rows.start, history.reshape(*shape, *history.shape[1:]), f.reshape(shape))
        end = rows.stop if rows.stop == self.passage.y.size else rows.stop - reach
        if self.tail is not None:
            self._search(self.tail.joined(block.part(0, 2 * reach)), min(rows.start + reach, end))
        self._search(block, end)
        short = self.tail is not None and shape[1] < 2 * reach
        self.tail = (self.tail.joined(block) if short else block).part(-2 * reach, None) if reach else None

    def _search(self, part, end):
        """Search the rows from the last searched one to `end` by the Rows `part`, as far as they may be the worst."""
        rows = np.arange(self.done, end)
        self.done = max(self.done, end)
        columns, rows = (one.ravel() for one in np.meshgrid(np.arange(self.passage.x.size), rows, indexing="ij"))
        if not columns.size:
            return
        most = self._bounds(part, columns, rows)
        order = np.argsort(-most)
        for first in range(0, order.size, AT_ONCE):
            some = order[first : first + AT_ONCE]
            some = some[most[some] >= self._least()]
            if not some.size:
                break
            self._take(columns[some], rows[some], self._averaged(part, part.history, columns[some], rows[some]))

    def _bounds(self, part, columns, rows):
        """Largest possible values (Pa) at these points; infinite if the criterion is not convex."""
        if not CRITERIA[self.local.criterion].convex:
            return np.full(columns.size, np.inf)
        return (LOW if self.passage.sought.brief else 1.0) * self._averaged(part, part.f[..., None], columns, rows)[:, 0]

    def _least(self):
        """Least value (Pa) that matters."""
        if self.worst is None:
            return -np.inf
        return self.worst.f - (1 - CLOSE) * abs(self.worst.f) if self.passage.follows else self.worst.f

    def _averaged(self, part, values, columns, rows):
        """Averages (points, ...) of values (x', rows of `part`, ...) around these points."""
        out = np.zeros((columns.size, *values.shape[2:]))
        for i, along in self.parts[0]:
            near = np.clip(columns + i, 0, self.passage.x.size - 1)
            for j, across in self.parts[1]:
                there = rows + j
                one = values[near, np.clip(abs(there) if self.mirrored else there, 0, self.passage.y.size - 1) - part.first]
                if self.mirrored and values.shape[-1] == len(COMPONENTS):
                    one[np.ix_(there < 0, np.arange(one.shape[1]), ODD)] *= -1
                out += along * across * one
        return out

    def _take(self, columns, rows, histories):
        """Search the averaged histories of some points."""
        passage = self.passage
        f, normals = findley.search(histories, self.local.kappa, criterion=self.local.criterion)
        self.f[columns, rows] = f

        def places(n):
            return 0.0, passage.x[columns[n]], passage.y[rows[n]]

        self.worst = worse(self.worst, places, histories, f, normals, self.local)
        if self.passage.follows:
            self.close = close_ones(self.close, places, histories, f, normals, self.local)


class Rows:
    """Histories (x', rows, moments, 6) Pa of neighbouring rows and their values f (x', rows) Pa; first: number of the first
    row."""

    def __init__(self, first, history, f):
        self.first, self.history, self.f = first, history, f

    def part(self, low, high):
        """Copy of some of these rows, from `low` to `high`."""
        first = self.first + (slice(low, high).indices(self.f.shape[1])[0])
        return Rows(first, self.history[:, low:high].copy(), self.f[:, low:high].copy())

    def joined(self, other):
        """These rows and those that follow them."""
        return Rows(self.first, *(np.concatenate(pair, axis=1) for pair in ((self.history, other.history), (self.f, other.f))))
