"""Loads averaged over a length.

The half-space is homogeneous, so stresses of averaged loads are the averages of the stresses over that length, at the surface
and at any depth. A material has a characteristic length (Taylor, The Theory of Critical Distances, 2007): its fatigue depends
on a stress over a distance, not at a point; and at a jump of the surface shear sigma_xx is a logarithm of the distance.
"""

from dataclasses import replace

import numpy as np


def weights(length, spacing):
    """Shares of `length` (m) around a node in the cells of its neighbours, from one side to the other; one weight if the length
    is at most a cell.
    """
    reach = max(0, int(np.ceil(length / (2 * spacing) - 0.5 - 1e-9)))
    if reach == 0:
        return np.ones(1)
    ends = np.clip((np.arange(-reach, reach + 2) - 0.5) * spacing, -length / 2, length / 2)
    return np.diff(ends) / length


def averaged(field, parts, axis=0, mirrored=False, odd=False):
    """Averages of a field along `axis` by :func:`weights`. Beyond its ends it is constant; mirrored: the first row is a
    symmetry axis; odd: antisymmetric.
    """
    if parts.size == 1:
        return field
    along, reach = np.moveaxis(np.asarray(field), axis, 0), parts.size // 2
    before = along[reach:0:-1] * (-1 if odd else 1) if mirrored else np.repeat(along[:1], reach, axis=0)
    wide = np.concatenate([before, along, np.repeat(along[-1:], reach, axis=0)])
    out = sum(part * wide[n : n + len(along)] for n, part in enumerate(parts))
    return np.moveaxis(out, 0, axis)


class AveragedReader:
    """Reader for :class:`tehl_taichi.fatigue.stress.histories.StressHistories` whose fields are averages over a square of
    `length` (m) parallel to the surface. Rows that begin at y = 0 have their mirror on the other side.
    """

    def __init__(self, reader, length):
        self.reader, self.x, self.y, self.time, self.feature_x = reader, reader.x, reader.y, reader.time, reader.feature_x
        self.along, self.across = (weights(length, float(side[1] - side[0])) if len(side) > 1 else np.ones(1)
                                   for side in (reader.x, reader.y))
        self.mirrored = is_mirrored(reader)
        if hasattr(reader, "parts"):
            self.parts = reader.parts
        self.residual_fields = {name: field.averaged(self.along, self.across, self.mirrored)
                                for name, field in getattr(reader, "residual_fields", {}).items()}

    def __len__(self):
        return len(self.reader)

    def fields(self, n, names):
        """{name: (nx+1, ny+1) array} of entry n."""
        return self.over_square(self.reader.fields(n, names), self.mirrored)

    def over_square(self, fields, mirrored):
        """Averages of {name: (columns, rows)}; mirrored: the first row is a symmetry axis."""
        return {name: averaged(averaged(field, self.along), self.across, 1, mirrored, name.startswith("traction_y"))
                for name, field in fields.items()}


class WindowedAverages(AveragedReader):
    """Averaged reader with averaged windows (:class:`tehl_taichi.fatigue.stress.windowed.WindowedStresses`)."""

    def __init__(self, reader, length):
        super().__init__(reader, length)
        self.factor, self.base = reader.factor, AveragedReader(reader.base, length)
        self.averaged, self.kept_heat, self.tables = length, reader.kept_heat, reader.tables
        self.windows = [AveragedWindow(self, window) for window in reader.windows]

    @property
    def every(self):
        """The averaged reader of all moments of the windows, or None."""
        return self.reader.every and WindowedAverages(self.reader.every, self.averaged)


class AveragedWindow:
    """A window of a reader with its loads and temperatures averaged; reader: the WindowedAverages."""

    def __init__(self, reader, window):
        self.reader, self.window, self.extent, self.pace = reader, window, window.extent, window.pace
        self.at_axis = reader.mirrored and window.extent.row == 0

    def inside(self, n, names):
        """The Inside of entry n, or None."""
        if (found := self.window.inside(n, names)) is None:
            return None
        return replace(found, fine=self.reader.over_square(found.fine, self.at_axis),
                       coarse=self.reader.base.over_square(found.coarse, self.at_axis))

    def difference(self, n, name):
        """(first fine column, (columns, rows) K of the window less the run) of entry n, or None."""
        found = self.window.difference(n, name)
        return found and (found[0], self.reader.over_square({name: found[1]}, self.at_axis)[name])


def averaged_reader(reader, length):
    """Averages of a reader over a square of `length` (m), with its window if it has one."""
    return (WindowedAverages if has_window(reader) else AveragedReader)(reader, length)


def is_mirrored(reader):
    """Whether the rows of a reader are one half of a contact, mirrored about y = 0."""
    return len(reader.y) > 1 and reader.y[0] == 0


def has_window(reader):
    """Whether a reader has a fine window."""
    return hasattr(reader, "windows")
