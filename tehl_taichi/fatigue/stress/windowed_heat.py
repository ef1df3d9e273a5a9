"""Thermal stresses of a run with fine windows: of the run's temperatures, and of the difference that each window makes."""

import functools

import numpy as np

from tehl_taichi.fatigue.stress.averaging import is_mirrored
from tehl_taichi.fatigue.stress.histories import NODES, between, shifted
from tehl_taichi.fatigue.stress.thermal_depth import ThermalBelow
from tehl_taichi.fatigue.stress.thermal_stress import ThermalStress
from tehl_taichi.fatigue.stress.unit_loads import ACROSS, HELD
from tehl_taichi.fatigue.stress.windowed import RunNodes

ROOM = 1.5  # rows of the grid per row of a window that begins at the mirror: space for stresses beside the window
WEAK = 1e-3  # waves of the difference below this share of the strongest are left out
SIDE = max(NODES) + 1  # columns on each side of a field that the interpolation between its columns needs


class WindowedHeat:
    """Thermal stress of the body of a passage whose reader has windows; used like ThermalStress or ThermalBelow.

    passage: StressHistories; its reader is as for :class:`tehl_taichi.fatigue.stress.windowed.WindowedStresses`, and its
    windows have `pace` and `difference(entry, name)`, which returns (first fine column, (columns, rows) K of the window less
    the run) or None. kind, of_change: functions that make the thermal stress of the run and of the difference.
    """

    @classmethod
    def on_the_surface(cls, passage):
        """Make the thermal stress at the surface, for :meth:`on`."""
        return cls(passage, ThermalStress, ThermalStress)

    @classmethod
    def below(cls, passage, shallowest):
        """Make the thermal stress below the surface, from the depth `shallowest` (m) on, for :meth:`rows`."""
        kind = functools.partial(ThermalBelow, shallowest=shallowest)
        return cls(passage, kind, functools.partial(kind, lead=0.0, weak=WEAK), shallowest)

    def __init__(self, passage, kind, of_change, shallowest=0.0):
        self.passage, self.reader, self.shallowest = passage, passage.reader, shallowest
        self.kind, self.nodes = kind, RunNodes(passage, np.zeros(0, int))
        self.entries = {int(tick): entry for entry, tick in enumerate(passage.ticks)}
        changes = (WindowChange.of(passage, window, of_change) for window in self.reader.windows)
        self.changes = [change for change in changes if change]

    @functools.cached_property
    def base(self):
        """Thermal stress of the run without the window; at the surface it is kept for windows of other factors."""
        if self.kind is not ThermalStress:
            return self._of_run()
        key = self.passage.surface.name, self.reader.averaged, self.nodes.front, self.nodes.x.size
        kept = self.reader.kept_heat
        if key not in kept:
            kept[key] = self._of_run()
        return kept[key]

    def _of_run(self):
        run, nodes, passage = self.reader.base, self.nodes, self.passage
        grid = run.x, run.y, nodes.front, nodes.x.size
        return passage.heat_of(self.kind, passage.rises(run), grid, passage.reflects, passage.a, passage.surface.speed)

    def on(self, rows):
        """Function of a tick (number of an equal step) that returns sxx, syy, sxy (columns, rows, 3) Pa on these fine rows."""
        nodes = RunNodes(self.passage, np.asarray(rows))
        run, changes = self.base.on(nodes.rows), [change.on(rows) for change in self.changes]

        def stresses(tick):
            out = nodes.refined(run(tick)[None], [self._band(tick)], ACROSS[list(HELD)])[0]
            for add in changes:
                add(out, tick)
            return out

        return stresses

    def rows(self, depth, rows):
        """Stresses (rows, ticks, columns, 6) Pa at `depth` (m) on some fine rows."""
        between_rows = self._run_rows(depth, rows)
        bands = [self._band(tick) for tick in range(between_rows.shape[1])]
        out = self.nodes.refined_along(np.moveaxis(between_rows, 0, 2), bands)
        for change in self.changes:
            change.add_rows(out, depth, rows)
        return np.moveaxis(out, 2, 0)

    def _band(self, tick):
        """Slice of the columns that the histories use of the entry at a tick; empty if no entry is at this tick."""
        return self.passage.band(self.entries.get(int(tick), -1))

    def _run_rows(self, depth, rows):
        """Stresses (rows, ticks, columns of the run, 6) Pa of the run at a depth on fine rows, kept for windows of other
        factors.

        Waves have values between the run's rows, so no interpolation along y is needed.
        """
        places = np.asarray(rows) / self.reader.factor
        kept, nodes = self.reader.kept_heat, self.nodes
        keys = [(self.passage.surface.name, self.reader.averaged, float(depth), float(place), nodes.front, nodes.x.size)
                for place in places]
        if not all(key in kept for key in keys):
            kept |= zip(keys, self.base.rows(depth, places).astype(np.float32))
        return np.stack([kept[key] for key in keys])


class WindowChange:
    """Thermal stress of the difference that a window of the reader makes.

    frame: its WindowFrame; own: thermal stress in it; arguments and names are those of :class:`WindowedHeat`.
    """

    @classmethod
    def of(cls, passage, window, kind):
        """The WindowChange of a window; None if the window has no entries."""
        found = [window.difference(n, f"temperature_{passage.surface.name}") for n in range(len(passage.reader))]
        return cls(passage, window, kind, found) if any(found) else None

    def __init__(self, passage, window, kind, found):
        frame = self.frame = WindowFrame(passage, window, found)
        self.extent, ticks = window.extent, passage.ticks[frame.first :]
        rises = between((frame.rise(one, tick) for one, tick in zip(found[frame.first :], ticks)), ticks - frame.begin)
        grid = frame.x, frame.y, 0, frame.x.size
        self.own = passage.heat_of(kind, rises, grid, is_mirrored(passage.reader), 0.0, frame.speed)

    def on(self, rows):
        """Function that adds the stresses sxx, syy, sxy at a tick on these fine rows to an array (columns, rows, 3) Pa."""
        places, own = self._within(rows)
        window = self.own.on(own) if own else None

        def add(out, tick):
            if window and tick > self.frame.begin:
                self.frame.add(out, places, window(tick - self.frame.begin), tick)

        return add

    def add_rows(self, out, depth, rows):
        """Add the stresses at a depth (m) on some fine rows to `out` (ticks, columns, rows, 6) Pa."""
        places, own = self._within(rows)
        if own:
            for n, field in enumerate(np.moveaxis(self.own.rows(depth, own), 0, 2)):
                self.frame.add(out[self.frame.begin + n], places, field, self.frame.begin + n)

    def _within(self, rows):
        """(places in `rows`, numbers in the window) of the fine rows that lie in the window."""
        w, rows = self.extent, np.asarray(rows)
        places = np.flatnonzero((rows >= w.row) & (rows < w.row + w.rows))
        return places, list(rows[places] - w.row)


class WindowFrame:
    """Grid that moves with a window and contains it at every tick (number of an equal step).

    window: one of the windows of the reader. found: for every entry (first fine column, (columns, rows) K) of the window, or
    None without one. Attributes: `x`, `y` (m);
    `first`, the last entry before the window, and `begin`, its tick; `speed` of the body in this frame, m/s.
    """

    def __init__(self, passage, window, found):
        self.passage, reader, columns = passage, passage.reader, window.extent.columns
        self.first = next(n for n, one in enumerate(found) if one is not None) - 1
        self.begin, dx = int(passage.ticks[self.first]), float(reader.x[1] - reader.x[0])
        whole = (passage.path[1] - passage.path[0]) / dx / int(passage.ticks[-1])  # columns per tick of the first feature
        self.way = window.pace * whole
        self.speed = passage.surface.speed - self.way * dx / passage.tick
        places = [one[0] - self.way * tick for one, tick in zip(found, passage.ticks) if one is not None]
        trail = int(abs(passage.surface.pace - window.pace) * whole * (int(passage.ticks[-1]) - self.begin)) + 1
        trail = min(trail, columns)  # of the heat that the body takes out of the window
        self.left = min(places) - SIDE - (trail if self.speed < 0 else 0)
        size = int(np.ceil(max(places) - self.left)) + columns + SIDE + (trail if self.speed > 0 else 0)
        self.x, self.y = np.arange(size) * dx, self._rows(reader, window.extent)

    def rise(self, one, tick):
        """Difference of temperatures (columns, rows) K on this grid; one: (first fine column, values) of the window, or
        None."""
        out = np.zeros((self.x.size, self.y.size), np.float32)
        if one is not None:
            at = one[0] - self._left(tick)
            whole = int(np.floor(at + 1e-6))
            values = np.pad(one[1], ((2 * SIDE, 2 * SIDE), (0, 0)))
            moved = shifted(values, SIDE - (at - whole), len(values) - 2 * SIDE)
            out[whole - SIDE : whole - SIDE + len(moved), : moved.shape[1]] = moved
        return out

    def add(self, out, places, own, tick):
        """Add stresses `own` on this grid at a tick to the stresses `out` (columns of the passage, rows, ...).

        places: numbers of the rows of `out`.
        """
        first = int(np.ceil(self._left(tick) - 1e-6)) + SIDE
        pad = self.passage.pad[0]
        low, high = max(first, -pad), min(first + len(own) - 2 * SIDE, len(out) - pad)
        if low < high:
            out[pad + low : pad + high, places] += shifted(own, low - self._left(tick), high - low)

    def _left(self, tick):
        """Fine column (with fraction) of the passage at which this grid begins."""
        return self.left + self.way * tick

    @staticmethod
    def _rows(reader, w):
        """y (m) of the rows: those of the window (Extent `w`), and at a mirror ROOM times as many."""
        y = np.asarray(reader.y)
        if w.rows == 1:
            return y
        rows = w.rows + round((ROOM - 1) * w.rows) * (w.row == 0)
        return y[w.row] + np.arange(rows) * (y[1] - y[0])
