"""A run with its window, as one run on the fine grid: what fatigue is searched in."""

import numpy as np

from tehl_taichi.march.zoom.refining import Refining

EXTREMES = {"p_max_Pa": ("pressure", np.max), "h_min_m": ("film", np.min)}  # numbers of an entry that the window changes


class ZoomedReader:
    """As :class:`tehl_taichi.fatigue.stress.histories.StressHistories` takes it: fields of `reader`, whose nodes are `factor`
    times as far apart, with those of the :class:`tehl_taichi.march.zoom.zoomed_passage.ZoomedPassage` in them."""

    def __init__(self, reader, zoomed, mirrored):
        self.reader, self.zoomed, w = reader, zoomed, zoomed.window
        self.time, self.feature_x = reader.time, reader.feature_x
        self.x, self.y = (_between(side, w.factor) for side in (reader.x, reader.y))
        self.place = {entry: n for n, entry in enumerate(zoomed.entries)}
        self.refining = Refining((0, 0), (self.y.size, self.x.size), w.factor, (len(reader.y), len(reader.x)), mirrored)
        self.series = {name: np.array(reader.scalar(name), float) for name in EXTREMES}
        for entry in zoomed.entries:
            self._take_extremes(entry)
        for name, values in zoomed.numbers.items():
            self.series[name] = np.array(reader.scalar(name), float)
            self.series[name][zoomed.entries] = values

    def __len__(self):
        return len(self.reader)

    def scalar(self, name):
        """Values of a number, one per entry."""
        return self.series[name] if name in self.series else self.reader.scalar(name)

    def _take_extremes(self, n):
        """The largest pressure and the least film of entry n: of the window in its core, of the run elsewhere."""
        at = self.place[n]
        inside, outside = (of(self.zoomed.origins[at]).T for of in (self.zoomed.window.inside, self.zoomed.window.outside))
        run = self.reader.fields(n, tuple(field for field, _ in EXTREMES.values()))
        for name, (field, extreme) in EXTREMES.items():
            own = self.zoomed.fields[field][at]
            self.series[name][n] = extreme(np.concatenate([run[field][outside], own[inside]]))

    def fields(self, n, names):
        """{name: (nx+1, ny+1) array} of entry n."""
        return {name: self._field(name, n, field) for name, field in self.reader.fields(n, names).items()}

    def _field(self, name, n, field):
        field = np.asarray(field, float).T
        out = self.refining.pressure(field) if name == "pressure" else self.refining.smooth(field, 2)
        if n in self.place:
            self._paste(out, name, self.place[n])
        return np.ascontiguousarray(out.T)

    def _paste(self, out, name, n):
        w, origin = self.zoomed.window, self.zoomed.origins[n]
        columns, rows = np.arange(origin, origin + w.nx + 1), np.arange(w.row, w.row + w.ny + 1)
        part = w.core(columns, rows, origin)
        own = out[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
        own += part * (self.zoomed.fields[name][n].T - own)


def extreme(reader, name):
    """A number of the passage in a reader that windows change."""
    reduce = EXTREMES[name][1] if name in EXTREMES else np.max
    return float(reduce(reader.scalar(name)[1:]))


def _between(places, factor):
    """Places with factor - 1 more between neighbours."""
    fine = np.arange((len(places) - 1) * factor + 1) / factor
    return np.interp(fine, np.arange(len(places)), places)
