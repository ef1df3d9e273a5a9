"""Stress of a hot layer at the surface that is held in its plane: the part of the thermal stress that changes as fast as the
temperature (:mod:`tehl_taichi.fatigue.stress.thermal_stress` has the rest)."""

import numpy as np

from tehl_taichi.fatigue.stress.averaging import is_mirrored
from tehl_taichi.fatigue.stress.half_space import COMPONENTS
from tehl_taichi.fatigue.stress.thermal_stress import stiffness
from tehl_taichi.fatigue.stress.windowed import POINTS
from tehl_taichi.values.refining import Refining


def histories(passage, rows):
    """{row: stress (x', moments, 6) Pa} of the points of some rows at the surface; the last moment is unloaded.

    passage: StressHistories of a reader with a window; rows: numbers of fine rows.
    """
    first, out = min(rows), {}
    held = np.zeros((passage.x.size, max(rows) + 1 - first, passage.centres.size + 1, 1))
    for block in passage.blocks:
        passage.follow(held, {int(entry): _rises(passage, int(entry), first, held.shape[1]) for entry in block})
    for row in rows:
        out[row] = np.zeros((passage.x.size, held.shape[2], len(COMPONENTS)))
        out[row][..., :2] = -stiffness(passage.surface.body) * held[:, row - first]
    return out


def _rises(passage, entry, first, count):
    """Temperature rises (columns of the passage, count, 1) K of an entry on `count` fine rows from `first` on.

    Only columns that the histories use are computed; beside the grid they have the rises at its ends.
    """
    reader, name, band, front = passage.reader, f"temperature_{passage.surface.name}", passage.band(entry), passage.pad[0]
    run = np.asarray(reader.base.fields(entry, (name,))[name], float).T
    size = count, band.stop - band.start
    refining = Refining((first, band.start - front), size, reader.factor, run.shape, is_mirrored(reader))
    out = np.zeros((passage.grid_x.size, count))
    out[band] = refining.smooth(run, POINTS).T
    for window in reader.windows:
        _add_change(out[front:], window, entry, name, first)
    return (out - passage.scene.operation.temperature)[..., None]


def _add_change(out, window, entry, name, first):
    """Add the change of a temperature by a window of the reader to `out` (columns, rows from `first` on) K."""
    if (found := window.difference(entry, name)) is not None:
        column, change = found
        rows = first + np.arange(out.shape[1]) - window.extent.row
        inside = (rows >= 0) & (rows < window.extent.rows)
        out[column : column + len(change), inside] += change[:, rows[inside]]
