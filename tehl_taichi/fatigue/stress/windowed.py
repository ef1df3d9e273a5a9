"""Stresses of a run with a fine window: those of the run on its own grid, and what the window changes near it.

The loads are those of the run outside of the window and the window's inside, and the half-space is linear. So the stresses of
the run's loads are found on its grid and interpolated; to them come, at the nodes of the window, those of its loads less those
of the part of the run's loads that they replace, each on a grid of the window's size. What is sharp inside the window in the
run cancels, and nothing is computed on a fine grid of the whole contact. Temperatures differ from the run's by little: their
stresses are those of the run and of that difference.
"""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.engine.fftw import real_of
from tehl_taichi.fatigue.stress.row_stress import RowStress
from tehl_taichi.fatigue.stress.unit_loads import ACROSS
from tehl_taichi.values.refining import matrix

POINTS = 6  # of the polynomials between the nodes of the run
MARGIN = 3  # cells of the run beside the window, so that they have nodes on both sides
BESIDE = 16  # a multiple of so many columns lies beside the grid of the run: windows of any factor have the same


@dataclass(frozen=True)
class Inside:
    """A window at one moment: number of its first fine column, its weight (columns, rows) of the core, its loads with that
    weight, and those of the run with it at the nodes of the run from MARGIN cells before the window on: {name: (columns,
    rows)} Pa."""

    column: int
    core: np.ndarray
    fine: dict
    coarse: dict


@dataclass(frozen=True)
class Extent:
    """A window that moves along x: cells of it to one of the run, its columns and rows of nodes and its first fine row."""

    factor: int
    columns: int
    rows: int
    row: int

    @property
    def coarse_columns(self):
        """Columns of nodes of the run round the window."""
        return (self.columns - 1) // self.factor + 2 + 2 * MARGIN

    @property
    def coarse_rows(self):
        """(first, number) of the rows of the run round it; one of a line."""
        if self.rows == 1:
            return 0, 1
        first = max(self.row // self.factor - MARGIN, 0)
        return first, -(-(self.row + self.rows - 1) // self.factor) + MARGIN + 1 - first

    def coarse_column(self, column):
        """Number of the first node of the run round a window that begins at this fine column."""
        return column // self.factor - MARGIN


class WindowedStresses:
    """Stresses of the loads of some entries of a passage, as those without a window
    (:mod:`tehl_taichi.fatigue.stress.row_histories`).

    passage: StressHistories of a reader with a `window` (:class:`Extent`), `base` (the reader of the run alone) and
    `inside(entry, names)`, the Inside of that moment or None. depths: m, increasing; rows: of the reader, by their numbers;
    kind: precision.
    """

    def __init__(self, passage, depths, rows, kind):
        rows = np.asarray(rows)
        self.base, self.window = BasePart(passage, depths, rows, kind), WindowPart(passage, depths, rows, kind)

    def __call__(self, block):
        """(entries, columns, rows, depths, 6) Pa of entries that have a place in one block."""
        out = self.base(block)
        self.window.add(out, block)
        return out


class BasePart:
    """Stresses of the run's own loads at the fine columns of a passage and these of its rows."""

    def __init__(self, passage, depths, rows, kind):
        self.reader, self.passage, self.kind = passage.reader.base, passage, kind
        b = self.between = RunNodes(passage, rows)
        self.operator = RowStress(b.x, self.reader.y, passage.surface.body.nu, passage.line, passage.mirrored, depths, b.rows,
                                  kind, passage.reader.tables)

    def __call__(self, block):
        """As :meth:`WindowedStresses.__call__`."""
        b, size = self.between, self.passage.block
        loads = np.zeros((3, size, b.x.size, len(self.reader.y)), real_of(self.kind))
        for entry in block:
            fields = self.reader.fields(int(entry), self.passage.loads_of)
            loads[:, entry % size, b.front : b.front + len(self.reader.x)] = self.passage.loads_from(fields)
        return b.refined(self.operator(*loads)[block % size], [self.passage.band(entry) for entry in block])


class WindowPart:
    """What the window adds to them."""

    def __init__(self, passage, depths, rows, kind):
        reader, self.passage, self.kind = passage.reader, passage, kind
        w = self.extent = reader.window
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
        """To stresses `out` (entries, columns, rows, depths, 6) of a block."""
        found = {int(entry): inside for entry in block if (inside := self._inside(int(entry)))} if self.within.size else {}
        if not found:
            return
        fine, coarse = self._stresses(found, "fine", self.fine), self._stresses(found, "coarse", self.coarse)
        for at, entry in enumerate(block):
            if (inside := found.get(int(entry))) is not None:
                here = entry % self.passage.block
                self._put(out[at], inside, fine[here], coarse[here])

    def _inside(self, entry):
        return self.passage.reader.inside(entry, self.passage.loads_of)

    def _stresses(self, found, part, operator):
        """(entries of a block, columns, rows, depths, 6) of the loads of one part."""
        loads = np.zeros((3, self.passage.block, operator.x.size, operator.y.size), real_of(self.kind))
        for entry, inside in found.items():
            loads[:, entry % self.passage.block] = self.passage.loads_from(getattr(inside, part))
        return operator(*loads)

    def _put(self, out, inside, fine, coarse):
        w, first = self.extent, inside.column
        offset = first - w.coarse_column(first) * w.factor
        change = fine - self.odd.refined(coarse, slice(offset, offset + w.columns))
        columns = slice(self.passage.pad[0] + first, self.passage.pad[0] + first + w.columns)
        out[columns, self.within] += inside.core[:, self.own, None, None] * change


class Folded:
    """From rows of the run, and their columns, to fine ones; rows: numbers of those that the fine ones need."""

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
        """(fine columns, fine rows, ..., components) of a field (columns, rows, ..., components) at the rows `rows`; columns:
        those that are wanted of all fine ones between its own; components: signs of each about the plane of symmetry."""
        wide = self.along(field, columns)
        out = np.empty((len(wide), len(self.across[0]), *field.shape[2:]), field.dtype)
        for sign, across in zip((1, -1), self.across):
            some = np.flatnonzero(np.asarray(components) == sign)
            out[..., some] = np.moveaxis(np.tensordot(across.astype(field.dtype), wide[..., some], (1, 1)), 0, 1)
        return out

    def along(self, field, columns):
        """(fine columns, ...) of a field (columns, ...)."""
        return np.tensordot(matrix(self.factor, len(field), POINTS)[columns].astype(field.dtype), field, 1)


class RunNodes:
    """Nodes of the run from which stresses at the fine columns of a passage and some of its rows are interpolated: x (m), of
    which the first `front` lie before its grid, and numbers of its rows."""

    def __init__(self, passage, rows):
        reader, factor = passage.reader, passage.reader.window.factor
        before, after = (-(-(cells + factor * MARGIN) // (factor * BESIDE)) * BESIDE for cells in passage.pad)
        x, self.front = np.asarray(reader.base.x), before
        self.x = x[0] + (np.arange(x.size + before + after) - before) * (x[1] - x[0])
        self.first, self.count = before * factor - passage.pad[0], passage.grid_x.size
        self.folded = Folded(factor, (0, len(reader.base.y)), rows, len(reader.base.y), is_mirrored(reader))

    @property
    def rows(self):
        return list(self.folded.rows)

    def refined(self, fields, bands, components=ACROSS):
        """(entries, fine columns, fine rows, ..., components) of fields (entries, columns, rows, ..., components), in a band
        (slice) of columns of each, else 0."""
        return self._filled(fields, bands, lambda field, columns: self.folded.refined(field, columns, components))

    def refined_along(self, fields, bands):
        """(entries, fine columns, ...) of fields (entries, columns, ...), likewise."""
        return self._filled(fields, bands, self.folded.along)

    def _filled(self, fields, bands, refined):
        parts = [refined(field, slice(self.first + band.start, self.first + band.stop)) for field, band in zip(fields, bands)]
        out = np.zeros((len(parts), self.count, *parts[0].shape[1:]), parts[0].dtype)
        for field, band, part in zip(out, bands, parts):
            field[band] = part
        return out


def is_mirrored(reader):
    """Whether its rows are those of one half of a contact that has its mirror on the other side."""
    return len(reader.y) > 1 and reader.y[0] == 0
