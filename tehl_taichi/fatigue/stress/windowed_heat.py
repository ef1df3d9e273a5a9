"""Thermal stresses of a run with a fine window: those of the run's temperatures, and of what the window adds to them."""

import functools

import numpy as np

from tehl_taichi.fatigue.stress.histories import NODES, between, shifted
from tehl_taichi.fatigue.stress.thermal_depth import ThermalBelow
from tehl_taichi.fatigue.stress.thermal_stress import ThermalStress
from tehl_taichi.fatigue.stress.unit_loads import ACROSS, HELD
from tehl_taichi.fatigue.stress.windowed import RunNodes, is_mirrored

ROOM = 1.5  # times the rows of a window in front of its mirror image: rows beyond it, for what lies across
WEAK = 1e-3  # waves of the difference below this share of the strongest are left out
SIDE = max(NODES) + 1  # columns beside a field that interpolation between its columns takes


class WindowedHeat:
    """As ThermalStress or ThermalBelow, of the body of a passage (StressHistories) whose reader has a window: as of
    :class:`tehl_taichi.fatigue.stress.windowed.WindowedStresses`, and with `difference(entry, name)`, (first fine column,
    (columns, rows) K of the window less the run) or None. kind, of_change: makes that of the run, of the difference."""

    @classmethod
    def on_the_surface(cls, passage):
        """Stresses at the surface: :meth:`on`."""
        return cls(passage, ThermalStress, ThermalStress)

    @classmethod
    def below(cls, passage, shallowest):
        """Stresses below it, from the depth `shallowest` (m) on: :meth:`rows`."""
        kind = functools.partial(ThermalBelow, shallowest=shallowest)
        return cls(passage, kind, functools.partial(kind, lead=0.0, weak=WEAK))

    def __init__(self, passage, kind, of_change):
        self.passage, self.reader = passage, passage.reader
        self.kind, self.nodes = kind, RunNodes(passage, np.zeros(0, int))
        self.entries = {int(tick): entry for entry, tick in enumerate(passage.ticks)}
        found = [self.reader.difference(n, f"temperature_{passage.surface.name}") for n in range(len(self.reader))]
        self.frame = WindowFrame(passage, found) if any(found) else None
        self.own = self._of_window(of_change, found) if self.frame else None

    @functools.cached_property
    def base(self):
        """Heat of the run alone."""
        run, nodes, passage = self.reader.base, self.nodes, self.passage
        grid = run.x, run.y, nodes.front, nodes.x.size
        return passage.heat_of(self.kind, passage.rises(run), grid, passage.mirrored, passage.a, passage.surface.speed)

    def on(self, rows):
        """Function of a tick (one of the equal steps) that gives sxx, syy, sxy on these rows, (columns, rows, 3) Pa."""
        nodes, places, own = RunNodes(self.passage, np.asarray(rows)), *self._within(rows)
        run, window = self.base.on(nodes.rows), self.own.on(own) if self.own and own else None

        def stresses(tick):
            out = nodes.refined(run(tick)[None], [self._band(tick)], ACROSS[list(HELD)])[0]
            if window and tick > self.frame.begin:
                self.frame.add(out, places, window(tick - self.frame.begin), tick)
            return out

        return stresses

    def rows(self, depth, rows):
        """(rows, entries, columns, 6) Pa at `depth` on some rows."""
        places, own = self._within(rows)
        between_rows = self._run_rows(depth, rows)
        bands = [self._band(tick) for tick in range(between_rows.shape[1])]
        out = self.nodes.refined_along(np.moveaxis(between_rows, 0, 2), bands)
        if self.own and own:
            for n, field in enumerate(np.moveaxis(self.own.rows(depth, own), 0, 2)):
                self.frame.add(out[self.frame.begin + n], places, field, self.frame.begin + n)
        return np.moveaxis(out, 2, 0)

    def _band(self, tick):
        """Columns that the histories take of the entry at a tick; none where there is none."""
        return self.passage.band(self.entries.get(int(tick), -1))

    def _run_rows(self, depth, rows):
        """(rows, entries, columns of the run, 6) Pa, kept for windows of other factors: waves have values between rows, too."""
        places = np.asarray(rows) / self.reader.window.factor
        kept, nodes = self.reader.kept_heat, self.nodes
        keys = [(self.passage.surface.name, self.reader.averaged, float(depth), float(place), nodes.front, nodes.x.size)
                for place in places]
        if not all(key in kept for key in keys):
            kept |= zip(keys, self.base.rows(depth, places).astype(np.float32))
        return np.stack([kept[key] for key in keys])

    def _within(self, rows):
        """(places among `rows`, rows of the window) of those that lie in it."""
        w, rows = self.reader.window, np.asarray(rows)
        places = np.flatnonzero((rows >= w.row) & (rows < w.row + w.rows))
        return places, list(rows[places] - w.row)

    def _of_window(self, kind, found):
        frame = self.frame
        ticks = self.passage.ticks[frame.first :]
        rises = between((frame.rise(one, tick) for one, tick in zip(found[frame.first :], ticks)), ticks - frame.begin)
        grid = frame.x, frame.y, 0, frame.x.size
        return self.passage.heat_of(kind, rises, grid, is_mirrored(self.reader), 0.0, frame.speed)


class WindowFrame:
    """Columns that move with a window, `x` and `y` (m), wide enough for it at every tick (one of the equal steps) from `begin`
    on, that of the last entry before it; `first`: this entry; speed: of the body in them, m/s.

    found: of all entries (first fine column, (columns, rows)) of the window, or None.
    """

    def __init__(self, passage, found):
        self.passage, reader = passage, passage.reader
        self.first = next(n for n, one in enumerate(found) if one is not None) - 1
        self.begin, dx = int(passage.ticks[self.first]), float(reader.x[1] - reader.x[0])
        self.way = (passage.path[1] - passage.path[0]) / dx / int(passage.ticks[-1])  # columns per tick
        self.speed = passage.surface.speed - self.way * dx / passage.tick
        places = [one[0] - self.way * tick for one, tick in zip(found, passage.ticks) if one is not None]
        trail = int(abs(passage.surface.pace - 1) * self.way * (int(passage.ticks[-1]) - self.begin)) + 1
        trail = min(trail, reader.window.columns)  # of the heat that the body takes out of the window
        self.left = min(places) - SIDE - (trail if self.speed < 0 else 0)
        size = int(np.ceil(max(places) - self.left)) + reader.window.columns + SIDE + (trail if self.speed > 0 else 0)
        self.x, self.y = np.arange(size) * dx, self._rows(reader)

    def rise(self, one, tick):
        """Difference of temperatures, (columns, rows) K, of an entry's (first fine column, values) or None."""
        out = np.zeros((self.x.size, self.y.size), np.float32)
        if one is not None:
            at = one[0] - self._left(tick)
            whole = int(np.floor(at + 1e-6))
            values = np.pad(one[1], ((2 * SIDE, 2 * SIDE), (0, 0)))
            moved = shifted(values, SIDE - (at - whole), len(values) - 2 * SIDE)
            out[whole - SIDE : whole - SIDE + len(moved), : moved.shape[1]] = moved
        return out

    def add(self, out, places, own, tick):
        """To stresses `out` (columns of the passage, rows, ...) at these places among the rows, those of the window's columns
        at a tick."""
        first = int(np.ceil(self._left(tick) - 1e-6)) + SIDE
        pad = self.passage.pad[0]
        low, high = max(first, -pad), min(first + len(own) - 2 * SIDE, len(out) - pad)
        if low < high:
            out[pad + low : pad + high, places] += shifted(own, low - self._left(tick), high - low)

    def _left(self, tick):
        """Fine column of the grid at which the first of these lies."""
        return self.left + self.way * tick

    @staticmethod
    def _rows(reader):
        w, y = reader.window, np.asarray(reader.y)
        if w.rows == 1:
            return y
        rows = w.rows + round((ROOM - 1) * w.rows) * (w.row == 0)
        return y[w.row] + np.arange(rows) * (y[1] - y[0])
