"""One window of a run, as :class:`tehl_taichi.march.zoom.zoomed_reader.ZoomedReader` has it for the fatigue search."""

import numpy as np

from tehl_taichi.fatigue.stress.windowed import POINTS, Extent, Inside
from tehl_taichi.march.zoom import overlap
from tehl_taichi.march.zoom.overlap import PlacedWindow
from tehl_taichi.values.refining import Refining


class WindowReader:
    """A window and its values.

    base: reader of the run. zoomed: the :class:`tehl_taichi.march.zoom.zoomed_passage.ZoomedPassage` of the window; others:
    those of the other windows. mirrored: whether rows begin at a symmetry plane.
    """

    def __init__(self, base, zoomed, others, mirrored):
        w = zoomed.window
        self.base, self.zoomed, self.others, self.mirrored = base, zoomed, others, mirrored
        self.extent, self.pace = Extent(w.factor, w.nx + 1, w.ny + 1, w.row), w.pace
        self.place = {entry: n for n, entry in enumerate(zoomed.entries)}
        self.places = [{entry: n for n, entry in enumerate(other.entries)} for other in others]

    def placed(self, n):
        """The PlacedWindow at entry n."""
        return self._placed(self.zoomed, self.place[n], n)

    def _placed(self, zoomed, moment, n):
        """The PlacedWindow of a ZoomedPassage at its number `moment`, entry n of the run."""
        x, w = self.base.x, zoomed.window
        a = (x[1] - x[0]) / (w.factor * w.dx)
        return PlacedWindow.of(w, float(self.base.feature_x(n) / a), zoomed.origins[moment])

    def change(self, n, name, field):
        """(part of the fine grid (rows, columns), change) of a field (rows, columns) of the run at entry n by the window."""
        columns, rows = self._nodes(n)
        part = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
        return part, self._weight(n).T * (self._own(n, name).T - field[part])

    def inside(self, n, names):
        """The :class:`tehl_taichi.fatigue.stress.windowed.Inside` of entry n, or None."""
        if n not in self.place:
            return None
        placed, run, weight = self.placed(n), self.base.fields(n, names), self._weight(n)
        return Inside(placed.origin, placed.core(*self._nodes(n)).T, {name: weight * self._own(n, name) for name in names},
                      self._of_run(n, run))

    def difference(self, n, name):
        """(first fine column, difference (columns, rows)) of entry n, or None without a window.

        The difference is the field of the window less that of the run, times the weight of the window.
        """
        if n not in self.place:
            return None
        columns, rows = self._nodes(n)
        field = np.asarray(self.base.fields(n, (name,))[name], float).T
        refining = Refining((rows[0], columns[0]), (rows.size, columns.size), self.extent.factor, field.shape, self.mirrored)
        return int(columns[0]), self._weight(n) * (self._own(n, name) - refining.smooth(field, POINTS).T)

    def _own(self, n, name):
        """Field (columns, rows) of the window at entry n."""
        return self.zoomed.fields[name][self.place[n]]

    def _of_run(self, n, fields):
        """{name: field of the run} at its nodes around the window, times the weight of the window."""
        w, (first, count) = self.extent, self.extent.coarse_rows
        columns = w.coarse_column(self.placed(n).origin) + np.arange(w.coarse_columns)
        rows = first + np.arange(count)
        sides = (columns, len(self.base.x)), (rows, len(self.base.y))
        there = np.ix_(*(np.clip(places, 0, of - 1) for places, of in sides))
        weight = self._weight_at(n, w.factor * columns, w.factor * rows)
        return {name: weight * np.asarray(field)[there] for name, field in fields.items()}

    def _nodes(self, n):
        """(numbers of the fine columns, of the fine rows) of the window at entry n."""
        w, origin = self.extent, self.zoomed.origins[self.place[n]]
        return np.arange(origin, origin + w.columns), np.arange(w.row, w.row + w.rows)

    def _weight(self, n):
        """Weight (columns, rows) of the window at its nodes at entry n."""
        return self._weight_at(n, *self._nodes(n))

    def _weight_at(self, n, columns, rows):
        """Weight (columns, rows) of the window at nodes of the fine grid."""
        others = [self._placed(one, place[n], n) for one, place in zip(self.others, self.places) if n in place]
        return overlap.weight(self.placed(n), others, columns, rows).T
