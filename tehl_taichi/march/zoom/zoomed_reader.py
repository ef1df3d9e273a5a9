"""Reader of a run with its windows, as one run on the fine grid, for the fatigue search."""

import functools

import numpy as np

from tehl_taichi.march.zoom import overlap
from tehl_taichi.march.zoom.window_reader import WindowReader
from tehl_taichi.values.kept_arrays import KeptArrays
from tehl_taichi.values.refining import Refining

TABLE_BYTES = 1e8  # largest memory of the tables of unit loads, for both bodies, for pointwise and averaged stresses
EXTREMES = {"p_max_Pa": ("pressure", np.max), "h_min_m": ("film", np.min)}  # numbers of an entry that a window changes


class ZoomedReader:
    """Reader for :class:`tehl_taichi.fatigue.stress.histories.StressHistories`: a run on the fine grid, with windows in it.

    reader: of the run. zoomed: list of the :class:`tehl_taichi.march.zoom.zoomed_passage.ZoomedPassage` of its windows.
    mirrored: whether rows begin at a symmetry plane. `windows`: list of
    :class:`tehl_taichi.march.zoom.window_reader.WindowReader`.
    """

    def __init__(self, reader, zoomed, mirrored):
        self.base, self.zoomed, self.factor = reader, zoomed, zoomed[0].window.factor
        self.averaged, self.kept_heat, self.tables, self.peaks = 0.0, {}, KeptArrays(TABLE_BYTES), {}
        self.residual_fields = getattr(reader, "residual_fields", {})
        self.windows = [WindowReader(reader, one, [other for other in zoomed if other is not one], mirrored) for one in zoomed]
        self.time, self.feature_x = reader.time, reader.feature_x
        self.x, self.y = (_between(side, self.factor) for side in (reader.x, reader.y))
        nodes = self.y.size, self.x.size
        self.refining = Refining((0, 0), nodes, self.factor, (len(reader.y), len(reader.x)), mirrored)

    def __len__(self):
        return len(self.base)

    @functools.cached_property
    def every(self):
        """The ZoomedReader of all moments of the windows, also between the steps of the run; None without any."""
        from tehl_taichi.march.zoom.every_moment import every_moment

        return every_moment(self)

    @functools.cached_property
    def series(self):
        """{name: (entries,)} of the numbers that windows change."""
        own = {name: None for one in self.zoomed for name in one.numbers}
        out = {name: np.array(self.base.scalar(name), float) for name in {**EXTREMES, **own}}
        for entry in {entry: None for one in self.zoomed for entry in one.entries}:
            for name in out:
                out[name][entry] = self._extreme(name, entry)
        return out

    def scalar(self, name):
        """Values of a number, one per entry."""
        return self.series[name] if name in self.series else self.base.scalar(name)

    def _extreme(self, name, n):
        """A number of entry n: the extreme of the windows since the last entry and of the run outside.

        Temperatures of the windows contain those of the run outside.
        """
        there = [one for one in self.windows if n in one.place]
        found = [one.zoomed.numbers[name][one.place[n]] for one in there]
        if name not in EXTREMES:
            return np.max(found)
        field, extreme = EXTREMES[name]
        outside = self.base.fields(n, (field,))[field][overlap.outside([one.placed(n) for one in there]).T]
        return extreme([*found, *outside])  # nothing is outside a window as large as the grid

    def fields(self, n, names):
        """{name: (fine nodes along x, fine nodes along y)} of entry n, SI units."""
        return {name: self._field(name, n, field) for name, field in self.base.fields(n, names).items()}

    def _field(self, name, n, field):
        field = np.asarray(field, float).T
        out = self.refining.pressure(field) if name == "pressure" else self.refining.smooth(field, 2)
        for part, change in [one.change(n, name, out) for one in self.windows if n in one.place]:
            out[part] += change
        if name == "pressure":  # weights of two windows leave rounding errors where there is none
            np.maximum(out, 0.0, out=out)
        return np.ascontiguousarray(out.T)


def extreme(reader, name):
    """Extreme over the passage (without the start) of a number that windows change, such as "p_max_Pa"."""
    reduce = EXTREMES[name][1] if name in EXTREMES else np.max
    return float(reduce(reader.scalar(name)[1:]))


def _between(places, factor):
    """Nodes with factor - 1 further ones between neighbours."""
    fine = np.arange((len(places) - 1) * factor + 1) / factor
    return np.interp(fine, np.arange(len(places)), places)
