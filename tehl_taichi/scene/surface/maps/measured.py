"""Keys of the shapes with heights from a file, and quantities that follow from them."""

import dataclasses
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from tehl_taichi.scene.surface.maps import gaussian_filter, height_map, hole_filling, outliers, row_offsets
from tehl_taichi.scene.surface.maps.form import SurfaceForm
from tehl_taichi.scene.surface.maps.height_map import LEVELS, ROWS, Measures
from tehl_taichi.scene.surface.maps.length_units import UNITS
from tehl_taichi.scene.surface.maps.orientation import Orientation
from tehl_taichi.values.quantity import choice, quantity, switch, text

OFFSET = 0.03  # m
NEAREST, FARTHEST = 1e-10, 5e-4  # m, between points of a map: 0.001 was meant in mm


@dataclass(frozen=True)
class Measured:
    """Keys of a map or a line profile, and quantities that follow from them."""

    if TYPE_CHECKING:  # of the feature that has these keys
        kind: Any
        taper: float
    file: str = text("", "map, profile: CSV or NPY file (others with the `topography` extra); of a map each row is a line of "
                         "points along x; paths are relative to the scene file", most=4096, compare=False)
    unit: str = choice("", "map, profile: unit of the heights in the file; not given: as the file says", ("", *UNITS))
    scale: float = quantity(1.0, "", "map, profile: factor for the heights; -1 inverts them, as for a replica", -1e3, 1e3)
    pixel: float = quantity(0.0, "m", "map, profile: distance between points in a row of the file; 0: as the file says", 0.0,
                            FARTHEST, usual=1e-6)
    pixel_y: float = quantity(0.0, "m", "map: distance between rows of the file; 0: as the file says, or equal to pixel", 0.0,
                              FARTHEST, usual=1e-6)
    transpose: bool = switch(False, "map: the rows of the file run along y (across); pixel and pixel_y remain those of the "
                                    "file")
    mirror_x: bool = switch(False, "map, profile, rough, ground: reverse the heights along x (of a map after transpose)")
    mirror_y: bool = switch(False, "map, profile: reverse the heights along y (after transpose)")
    level: str = choice("plane", "map, profile: shape removed from the heights; form: plane and curvature", tuple(LEVELS))
    offset_x: float = quantity(0.0, "m", "map, profile: centre of the part used, from the centre of all heights; extent_x, "
                                         "extent_y: its size", -OFFSET, OFFSET, usual=1e-4)
    offset_y: float = quantity(0.0, "m", "map, profile: as offset_x, along y", -OFFSET, OFFSET, usual=1e-4)
    cutoff: float = quantity(0.0, "m", "map, profile: Gaussian low-pass (ISO 16610-61, -21), wavelength reduced to half its "
                                       "amplitude; 0: none", 0.0, 1e-2, usual=2e-5)
    sha256: str = text("", "map, profile: checksum of the heights, set when they are read; a file with other heights is then "
                           "refused")

    def __getstate__(self):
        """State without derived arrays."""
        return {key: value for key, value in self.__dict__.items()
                if key == "heights" or not isinstance(getattr(type(self), key, None), cached_property)}

    def __setstate__(self, state):
        """Restore the state; a copy in another process contains its heights."""
        self.__dict__.update(state)
        if "heights" in state:
            self.__dict__["heights"] = height_map.keep(self.heights)[1]

    @cached_property
    def heights(self):
        """Heights (rows, columns; one row of a profile) in the unit of the file, as when the feature was made; nan in holes."""
        return height_map.fetch(self.file, self.sha256)[1]

    @property
    def orientation(self):
        """The :class:`tehl_taichi.scene.surface.maps.orientation.Orientation` of its file."""
        return Orientation(self.kind.across(self), self.mirror_x, self.mirror_y)

    @cached_property
    def part(self):
        """Scaled heights (points along y, along x) in m of the used part, oriented as in the contact; nan in holes."""
        (low_x, high_x), (low_y, high_y) = self.ends
        turned = self.orientation.turned(self.heights)[low_y:high_y, low_x:high_x]
        found = np.ascontiguousarray(turned) * (UNITS[self.unit] * self.scale)
        return np.where(hole_filling.unmeasured(found), np.nan, found)  # differences of infinite heights make warnings

    @cached_property
    def ends(self):
        """Ranges ((first, after last) along x, along y) of the points of the used part, oriented as in the contact."""
        return tuple(_ends(*each) for each in zip(self.points, self.steps, self.patch, (self.offset_x, self.offset_y)))

    @cached_property
    def spikes(self):
        """Mask of points that are spikes of the measurement; they count as not measured."""
        return outliers.spikes(self.part, self.steps)

    @cached_property
    def raw(self):
        """Used part with filled holes and with its form."""
        return hole_filling.fill(np.where(self.spikes, np.nan, self.part))

    @property
    def holes(self):
        """Mask (along y, along x) of filled points of the used part."""
        return hole_filling.unmeasured(self.part) | self.spikes

    def nearest(self, x, y):
        """Indices (along y, along x) of the points nearest to x, y (m, from the centre; arrays or numbers)."""
        i, j = (np.clip(np.rint(at / step + (count - 1) / 2).astype(int), 0, count - 1)
                for at, step, count in zip((np.asarray(x), np.asarray(y)), self.steps, self.part.shape[::-1]))
        return j, i

    def place_in_file(self, j, i):
        """Text: position in the file of the point (j along y, i along x) of the used part."""
        (low_x, _), (low_y, _) = self.ends
        row, column = self.orientation.in_file(self.heights.shape, j + low_y, i + low_x)
        return self.kind.place_words(row + 1, column + 1)

    def position_in_file(self, x, y):
        """Text: position in the file of the point nearest to x, y (m, from the centre); "" beyond the patch."""
        if any(abs(at) > size / 2 for at, size in zip((x, y), self.patch)):
            return ""
        nearest = self.nearest(x, y)
        return self.place_in_file(*nearest) + ", not measured" * bool(self.holes[nearest])

    @cached_property
    def whole_heights(self):
        """Used part, levelled and filtered, not faded out."""
        return self.filtered(self.cutoff)

    @cached_property
    def levelled(self):
        """Used part without the form, plane or mean that `level` removes."""
        return height_map.levelled(self.raw, self.level) if self.level != ROWS else height_map.levelled(self.even_rows, "plane")

    @property
    def even_rows(self):
        """Used part without the offsets of the rows of its file."""
        rows = self.raw.T if self.orientation.transpose else self.raw
        rows = row_offsets.without_offsets(rows)
        return rows.T if self.orientation.transpose else rows

    @cached_property
    def row_offsets(self):
        """The :class:`tehl_taichi.scene.surface.maps.row_offsets.RowOffsets` of the rows of its file, or None."""
        flat = height_map.levelled(self.raw, "plane")
        return row_offsets.find(flat.T if self.orientation.transpose else flat)

    def filtered(self, cutoff):
        """Heights levelled and low-pass filtered with that cutoff (m; 0: none). A remaining plane passes unchanged, up to the
        rim.
        """
        flat = self.levelled
        if not cutoff:
            return flat
        rest = height_map.levelled(flat, "plane")
        return flat - rest + gaussian_filter.lowpass(rest, self.steps, cutoff)

    @cached_property
    def form(self):
        """The :class:`tehl_taichi.scene.surface.maps.form.SurfaceForm` of the measurement."""
        return SurfaceForm.of(self.raw, self.steps, self.part_size)

    @cached_property
    def cutoffs(self):
        """{(scales, grid): cutoff that helps there}: a cache for `scene.map_cutoff`, where each trial is a filter."""
        return {}

    @property
    def file_steps(self):
        """Distances (m) of its points (along a row of the file, from row to row)."""
        return self.pixel, self.pixel_y or self.pixel

    @property
    def steps(self):
        """Distances (m) of its points (along x, along y)."""
        return self.orientation.swapped(self.file_steps)

    @property
    def points(self):
        """Number of points (along x, along y)."""
        return self.orientation.swapped(self.heights.shape[::-1])

    @property
    def size(self):
        """Size (m) of the whole map (along x, along y); 0 along an axis of one point."""
        return tuple((count - 1) * step for count, step in zip(self.points, self.steps))

    @property
    def part_size(self):
        """Size (m) of the used part (along x, along y)."""
        return tuple((count - 1) * step for count, step in zip(self.part.shape[::-1], self.steps))

    @property
    def patch(self):
        """Size (m) of the used patch (along x, along y); inf along y for a profile without an end there."""
        return self.kind.patch(self)

    def to_rim(self, x, y):
        """Distances (m) of a point x, y (m, from the centre) from the rim of the patch (along x, along y); negative beyond
        it.
        """
        return tuple(size / 2 - abs(at) for size, at in zip(self.patch, (x, y)))

    @property
    def used(self):
        """Heights that pass through the contact: `whole_heights`, faded out at the rim of the patch."""
        return self.faded(self.whole_heights)

    def passing(self, cutoff):
        """Heights that would pass with another cutoff (m; 0: none)."""
        return self.faded(self.filtered(cutoff))

    def faded(self, values):
        """Values (points along y, along x) of the patch, faded out at its rim."""
        y, x = ((np.arange(count) - (count - 1) / 2) * step for count, step in zip(values.shape, self.steps[::-1]))
        return values * self.kind.window(self, x, y[:, None]) if self.taper else values

    @cached_property
    def measures(self):
        """Range and rms of the passing heights; the largest slope is that of the patch before fading."""
        return dataclasses.replace(Measures.of(self.used, self.steps), slope=self.unfaded.slope)

    @cached_property
    def unfaded(self):
        """Range, rms and largest slope of the patch before fading."""
        return Measures.of(self.whole_heights, self.steps)


def _ends(count, step, size, offset):
    """(first, after last) point of a part with this size, its centre moved by `offset` (m) in whole points."""
    cut = (count - 1 - round(size / step)) // 2 if count > 1 else 0
    moved = min(max(round(offset / step), -cut), cut)
    return cut + moved, count - cut + moved
