"""Stress of a hot layer at the surface that is held in its plane: the part of the thermal stress that changes as fast as the
temperature (:mod:`tehl_taichi.fatigue.stress.thermal_stress` has the rest)."""

import numpy as np

from tehl_taichi.fatigue.stress.half_space import COMPONENTS
from tehl_taichi.fatigue.stress.thermal_stress import stiffness
from tehl_taichi.fatigue.stress.windowed import POINTS, is_mirrored
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
    """Temperature rises (columns of the passage, count, 1) K of an entry on `count` fine rows from `first` on; beside the grid
    those at its ends."""
    reader, name = passage.reader, f"temperature_{passage.surface.name}"
    run = np.asarray(reader.base.fields(entry, (name,))[name], float).T
    refining = Refining((first, 0), (count, len(reader.x)), reader.window.factor, run.shape, is_mirrored(reader))
    out = refining.smooth(run, POINTS).T
    if (found := reader.difference(entry, name)) is not None:
        column, change = found
        rows = first + np.arange(count) - reader.window.row
        inside = (rows >= 0) & (rows < reader.window.rows)
        out[column : column + len(change), inside] += change[:, rows[inside]]
    return (np.pad(out, (passage.pad, (0, 0)), "edge") - passage.scene.operation.temperature)[..., None]
