"""Reader of a run with its window, as one run on the fine grid, for the fatigue search."""

import functools

import numpy as np

from tehl_taichi.fatigue.stress.kept_tables import KeptTables
from tehl_taichi.fatigue.stress.windowed import POINTS, Extent, Inside
from tehl_taichi.values.refining import Refining

EXTREMES = {"p_max_Pa": ("pressure", np.max), "h_min_m": ("film", np.min)}  # numbers of an entry that a window changes


class ZoomedReader:
    """Reader for :class:`tehl_taichi.fatigue.stress.histories.StressHistories`: a run on the fine grid, with a window in it.

    reader: of the run. zoomed: :class:`tehl_taichi.march.zoom.zoomed_passage.ZoomedPassage` of the window. mirrored: whether
    rows begin at a symmetry plane.
    """

    def __init__(self, reader, zoomed, mirrored):
        self.base, self.zoomed, w = reader, zoomed, zoomed.window
        self.averaged, self.kept_heat, self.tables, self.peaks = 0.0, {}, KeptTables(), {}
        self.residual_fields = getattr(reader, "residual_fields", {})
        self.window = Extent(w.factor, w.nx + 1, w.ny + 1, w.row)
        self.time, self.feature_x = reader.time, reader.feature_x
        self.x, self.y = (_between(side, w.factor) for side in (reader.x, reader.y))
        self.place = {entry: n for n, entry in enumerate(zoomed.entries)}
        self.refining = Refining((0, 0), (self.y.size, self.x.size), w.factor, (len(reader.y), len(reader.x)), mirrored)
    def __len__(self):
        return len(self.base)

    @functools.cached_property
    def every(self):
        """The ZoomedReader of all moments of the window, also between the steps of the run; None without any."""
        from tehl_taichi.march.zoom.every_moment import every_moment

        return every_moment(self)

    @functools.cached_property
    def series(self):
        """{name: (entries,)} of the numbers that a window changes."""
        out = {name: np.array(self.base.scalar(name), float) for name in {**EXTREMES, **self.zoomed.numbers}}
        for entry in self.zoomed.entries:
            self._take_extremes(out, entry)
        for name in self.zoomed.numbers.keys() - EXTREMES.keys():
            out[name][self.zoomed.entries] = self.zoomed.numbers[name]
        return out

    def scalar(self, name):
        """Values of a number, one per entry."""
        return self.series[name] if name in self.series else self.base.scalar(name)

    def _take_extremes(self, series, n):
        """Set the largest pressure and the smallest film of entry n: of the window since the last entry, of the run outside."""
        at = self.place[n]
        outside = self.zoomed.window.outside(self.zoomed.origins[at]).T
        run = self.base.fields(n, tuple(field for field, _ in EXTREMES.values()))
        for name, (field, extreme) in EXTREMES.items():
            series[name][n] = extreme([extreme(run[field][outside]), self.zoomed.numbers[name][at]])

    def fields(self, n, names):
        """{name: (fine nodes along x, fine nodes along y)} of entry n, SI units."""
        return {name: self._field(name, n, field) for name, field in self.base.fields(n, names).items()}

    def _field(self, name, n, field):
        field = np.asarray(field, float).T
        out = self.refining.pressure(field) if name == "pressure" else self.refining.smooth(field, 2)
        if n in self.place:
            self._paste(out, name, self.place[n])
        return np.ascontiguousarray(out.T)

    def _paste(self, out, name, n):
        """Replace the field `out` (rows, columns) inside the window by that of its moment n."""
        columns, rows = self._nodes(n)
        own = out[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
        own += self._core(n).T * (self.zoomed.fields[name][n].T - own)

    def inside(self, n, names):
        """The :class:`tehl_taichi.fatigue.stress.windowed.Inside` of entry n, or None."""
        if (at := self.place.get(n)) is None:
            return None
        core, run = self._core(at), self.base.fields(n, names)
        return Inside(self.zoomed.origins[at], core, {name: core * self.zoomed.fields[name][at] for name in names},
                      {name: self._of_run(at, field) for name, field in run.items()})

    def difference(self, n, name):
        """(first fine column, difference (columns, rows)) of entry n, or None without a window.

        The difference is the field of the window less that of the run, times the weight of the core.
        """
        if (at := self.place.get(n)) is None:
            return None
        columns, rows = self._nodes(at)
        field = np.asarray(self.base.fields(n, (name,))[name], float).T
        refining = Refining((rows[0], columns[0]), (rows.size, columns.size), self.window.factor, field.shape,
                            self.refining.mirrored)
        return int(columns[0]), self._core(at) * (self.zoomed.fields[name][at] - refining.smooth(field, POINTS).T)

    def _of_run(self, at, field):
        """A field of the run at its nodes around the window, times the weight of the core."""
        w, origin, (first, count) = self.window, self.zoomed.origins[at], self.window.coarse_rows
        columns = w.coarse_column(origin) + np.arange(w.coarse_columns)
        rows = first + np.arange(count)
        there = np.ix_(*(np.clip(places, 0, of - 1) for places, of in zip((columns, rows), field.shape)))
        core = self.zoomed.window.core(w.factor * columns, w.factor * rows, origin).T
        return core * np.asarray(field, float)[there]

    def _nodes(self, at):
        """(numbers of the fine columns, of the fine rows) of the window at a moment."""
        w, origin = self.zoomed.window, self.zoomed.origins[at]
        return np.arange(origin, origin + w.nx + 1), np.arange(w.row, w.row + w.ny + 1)

    def _core(self, at):
        """Weight (columns, rows) of the core at a moment."""
        return self.zoomed.window.core(*self._nodes(at), self.zoomed.origins[at]).T


def extreme(reader, name):
    """Extreme over the passage (without the start) of a number that windows change, such as "p_max_Pa"."""
    reduce = EXTREMES[name][1] if name in EXTREMES else np.max
    return float(reduce(reader.scalar(name)[1:]))


def _between(places, factor):
    """Nodes with factor - 1 further ones between neighbours."""
    fine = np.arange((len(places) - 1) * factor + 1) / factor
    return np.interp(fine, np.arange(len(places)), places)
