"""Stresses of a run with fine windows: the stresses of the run on its own grid, and their change by the windows.

Inside a window its loads replace the loads of the run. The half-space is linear, so the stresses are a sum of parts:

* the stresses of the run's loads, computed on the grid of the run and interpolated;
* at the nodes of each window, the stresses of its loads less the stresses of the replaced loads of the run. Both are computed
  on grids of the window's size. Details of the run's loads inside the window cancel.

So no stress is computed on a fine grid of the whole contact. Temperatures are treated likewise (`windowed_heat`).
"""

import itertools
from dataclasses import dataclass

import numpy as np

from tehl_taichi.engine.fftw import real_of
from tehl_taichi.fatigue.stress.averaging import is_mirrored
from tehl_taichi.fatigue.stress.row_stress import RowStress
from tehl_taichi.fatigue.stress.unit_loads import ACROSS
from tehl_taichi.fatigue.stress.workers import pool
from tehl_taichi.values.refining import matrix

POINTS = 6  # nodes of the polynomials between the nodes of the run
MARGIN = 3  # cells of the run around the window, so that these polynomials have nodes on both sides
BESIDE = 16  # the grid is extended by a multiple of so many columns, so that windows of all factors share it


@dataclass(frozen=True)
class Inside:
    """A window at one entry of the reader.

    column: number of its first fine column. core: (columns, rows), weight of its change of the stresses, 1 inside and 0 at its
    rim. fine, coarse: {name: (columns, rows) Pa}, loads times the weight of the window's values, which is that of the core, but
    less where another window overlaps it: of the window at its nodes, and of the run at the run's nodes, which begin MARGIN
    cells before the window.
    """

    column: int
    core: np.ndarray
    fine: dict
    coarse: dict


@dataclass(frozen=True)
class Extent:
    """Size of a window that moves along x.

    factor: fine cells per cell of the run; columns, rows: numbers of fine nodes; row: number of its first fine row.
    """

    factor: int
    columns: int
    rows: int
    row: int

    @property
    def coarse_columns(self):
        """Number of columns of the run around the window."""
        return (self.columns - 1) // self.factor + 2 + 2 * MARGIN

    @property
    def coarse_rows(self):
        """(first, number) of the rows of the run around the window; (0, 1) for a single row."""
        if self.rows == 1:
            return 0, 1
        first = max(self.row // self.factor - MARGIN, 0)
        return first, -(-(self.row + self.rows - 1) // self.factor) + MARGIN + 1 - first

    def coarse_column(self, column):
        """Number of the first column of the run around a window that begins at this fine column."""
        return column // self.factor - MARGIN


class WindowedStresses:
    """Stresses of the loads of the entries of a passage whose reader has windows; used by
    :mod:`tehl_taichi.fatigue.stress.row_histories`.

    passage: StressHistories of a reader with `base` (reader of the run without windows), `factor` (fine cells per cell of the
    run) and `windows`, a list; each has `extent` (:class:`Extent`) and `inside(entry, names)`, which returns the
    :class:`Inside` or None. depths: (n,) m, increasing; rows: numbers of fine rows of
    the reader; kind: precision of the transforms.
    """

    def __init__(self, passage, depths, rows, kind):
        rows = np.asarray(rows)
        self.base = BasePart(passage, depths, rows, kind)
        self.windows = [WindowPart(passage, window, depths, rows, kind) for window in passage.reader.windows]

    def __call__(self, block):
        """Stresses (entries, columns, rows, depths, 6) Pa of the entries of one block."""
        out = self.base(block)
        for window in self.windows:
            window.add(out, block)
        return out


class BasePart:
    """Stresses of the run's loads, interpolated to the fine columns and some fine rows; arguments: :class:`WindowedStresses`.

    A base reader with `parts(entry)`, [(another entry, weight)], has loads that are sums of those of a few steps of the run.
    """

    def __init__(self, passage, depths, rows, kind):
        self.reader, self.passage, self.kind = passage.reader.base, passage, kind
        b = self.between = RunNodes(passage, rows)
        self.operator = RowStress(b.x, self.reader.y, passage.surface.body.nu, passage.line, passage.mirrored, depths, b.rows,
                                  kind, passage.reader.tables)

        self.known = self._known() if hasattr(self.reader, "parts") else None

    def __call__(self, block):
        """See :meth:`WindowedStresses.__call__`."""
        return self.between.refined(self._stresses(block), [self.passage.band(entry) for entry in block])

    def _stresses(self, block):
        """Stresses (entries, columns, rows, depths, 6) Pa of some entries at the nodes of the run."""
        if self.known is None:
            return self._of_loads(block, block % self.passage.block)
        return np.stack([sum(weight * self.known[step] for step, weight in self.reader.parts(int(entry))) for entry in block])

    def _known(self):
        """{entry: stresses} of the steps of the run on which the entries depend; stresses are linear in the loads."""
        steps = sorted({step for entry in np.unique(self.passage.entries) for step, _ in self.reader.parts(int(entry))})
        blocks = [steps[n : n + self.passage.block] for n in range(0, len(steps), self.passage.block)]
        with pool(self.passage.nodes) as workers:
            found = workers.map(lambda block: self._of_loads(block, np.arange(len(block))), blocks)
            return dict(zip(steps, itertools.chain.from_iterable(found)))

    def _of_loads(self, entries, slots):
        """Stresses as of :meth:`_stresses` by the loads of at most a block of entries; slots: their places in the block."""
        b, size = self.between, self.passage.block
        loads = np.zeros((3, size, b.x.size, len(self.reader.y)), real_of(self.kind))
        for slot, entry in zip(slots, entries):
            fields = self.reader.fields(int(entry), self.passage.loads_of)
            loads[:, slot, b.front : b.front + len(self.reader.x)] = self.passage.loads_from(fields)
        return self.operator(*loads)[slots]


class WindowPart:
    """Change of the stresses by a window of the reader; other arguments: :class:`WindowedStresses`."""

    def __init__(self, passage, window, depths, rows, kind):
        reader, self.passage, self.window, self.kind = passage.reader, passage, window, kind
        w = self.extent = window.extent
        self.within = np.flatnonzero((rows >= w.row) & (rows < w.row + w.rows))
        self.own = rows[self.within] - w.row
        self.odd = Folded(w.factor, w.coarse_rows, rows[self.within], len(reader.base.y), mirrored=is_mirrored(reader))
        grid = reader.x[1] - reader.x[0], reader.y[1] - reader.y[0] if w.rows > 1 else 1.0
        nu, mirrored = passage.surface.body.nu, is_mirrored(reader) and w.row == 0

        def operator(columns, first, count, factor, these):
            x, y = np.arange(columns) * grid[0] * factor, (first + np.arange(count)) * grid[1] * factor
            y = y - (0.0 if mirrored else y[0])
            return RowStress(x, y, nu, w.rows == 1, mirrored, depths, list(these), kind, reader.tables)

        if self.within.size:
            self.fine = operator(w.columns, w.row, w.rows, 1, self.own)
            self.coarse = operator(w.coarse_columns, *w.coarse_rows, w.factor, self.odd.rows)

    def add(self, out, block):
        """Add the change to the stresses `out` (entries, columns, rows, depths, 6) Pa of a block."""
        found = {int(entry): inside for entry in block if (inside := self._inside(int(entry)))} if self.within.size else {}
        if not found:
            return
        fine, coarse = self._stresses(found, "fine", self.fine), self._stresses(found, "coarse", self.coarse)
        for at, entry in enumerate(block):
            if (inside := found.get(int(entry))) is not None:
                here = entry % self.passage.block
                self._put(out[at], inside, fine[here], coarse[here])

    def _inside(self, entry):
        return self.window.inside(entry, self.passage.loads_of)

    def _stresses(self, found, part, operator):
        """Stresses (entries of a block, columns, rows, depths, 6) Pa of the loads of one part, "fine" or "coarse"."""
        loads = np.zeros((3, self.passage.block, operator.x.size, operator.y.size), real_of(self.kind))
        for entry, inside in found.items():
            loads[:, entry % self.passage.block] = self.passage.loads_from(getattr(inside, part))
        return operator(*loads)

    def _put(self, out, inside, fine, coarse):
        """Add fine less interpolated coarse stresses to the stresses `out` (columns, rows, depths, 6) of one entry."""
        w, first = self.extent, inside.column
        offset = first - w.coarse_column(first) * w.factor
        change = fine - self.odd.refined(coarse, slice(offset, offset + w.columns))
        columns = slice(self.passage.pad[0] + first, self.passage.pad[0] + first + w.columns)
        out[columns, self.within] += inside.core[:, self.own, None, None] * change


class Folded:
    """Interpolation from columns and rows of the run to fine ones.

    factor: fine cells per cell of the run; coarse_rows: (first, number) of the rows of the run; rows: numbers of the fine rows;
    count: number of rows of the run's grid. Attribute `rows`: numbers of the run's rows that are needed.
    """

    def __init__(self, factor, coarse_rows, rows, count, mirrored):
        first, there = coarse_rows
        self.factor = factor
        if count == 1:
            self.rows, self.across = np.array([0]), [np.ones((len(rows), 1), np.float32)] * 2
            return
        whole = [matrix(factor, first + there, POINTS, mirrored, odd)[rows, first:] for odd in (False, True)]
        self.rows = np.flatnonzero(np.abs(whole[0]).sum(axis=0) + np.abs(whole[1]).sum(axis=0))
        self.across = [weights[:, self.rows].astype(np.float32) for weights in whole]

    def refined(self, field, columns, components=ACROSS):
        """Field (fine columns, fine rows, ..., components) from a field (columns, rows, ..., components) at the rows `rows`.

        columns: slice of the fine columns to compute; components: sign of each component in the mirror image about y = 0.
        """
        wide = self.along(field, columns)
        out = np.empty((len(wide), len(self.across[0]), *field.shape[2:]), field.dtype)
        for sign, across in zip((1, -1), self.across):
            some = np.flatnonzero(np.asarray(components) == sign)
            out[..., some] = np.moveaxis(np.tensordot(across.astype(field.dtype), wide[..., some], (1, 1)), 0, 1)
        return out

    def along(self, field, columns):
        """Field (fine columns, ...) from a field (columns, ...), at a slice of fine columns."""
        used = slice(max(columns.start // self.factor - POINTS, 0), columns.stop // self.factor + POINTS)
        return np.tensordot(matrix(self.factor, len(field), POINTS)[columns, used].astype(field.dtype), field[used], 1)


class RunNodes:
    """Nodes of the run for the interpolation to the fine columns of a passage and some of its fine rows.

    Attributes: `x` (m), whose first `front` columns lie before the run's grid; `rows`, numbers of the run's rows.
    """

    def __init__(self, passage, rows):
        reader, factor = passage.reader, passage.reader.factor
        before, after = (-(-(cells + factor * MARGIN) // (factor * BESIDE)) * BESIDE for cells in passage.pad)
        x, self.front = np.asarray(reader.base.x), before
        self.x = x[0] + (np.arange(x.size + before + after) - before) * (x[1] - x[0])
        self.first, self.count = before * factor - passage.pad[0], passage.grid_x.size
        self.folded = Folded(factor, (0, len(reader.base.y)), rows, len(reader.base.y), is_mirrored(reader))

    @property
    def rows(self):
        """Numbers of the rows of the run."""
        return list(self.folded.rows)

    def refined(self, fields, bands, components=ACROSS):
        """Fields (entries, fine columns, fine rows, ..., components) from (entries, columns, rows, ..., components).

        bands: for each entry the slice of fine columns to compute; other columns are 0.
        """
        return self._filled(fields, bands, lambda field, columns: self.folded.refined(field, columns, components))

    def refined_along(self, fields, bands):
        """Fields (entries, fine columns, ...) from (entries, columns, ...); bands as for :meth:`refined`."""
        return self._filled(fields, bands, self.folded.along)

    def _filled(self, fields, bands, refined):
        parts = [refined(field, slice(self.first + band.start, self.first + band.stop)) for field, band in zip(fields, bands)]
        out = np.zeros((len(parts), self.count, *parts[0].shape[1:]), parts[0].dtype)
        for field, band, part in zip(out, bands, parts):
            field[band] = part
        return out
