"""The measured side of a feature: its heights, what is asked of a map's keys, and what is refused."""

import os
from functools import cached_property

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import height_map
from tehl_taichi.scene.height_map import UNITS, Measures
from tehl_taichi.values.checks import number

MAX_RANGE, MAX_SLOPE = 1e-4, 45.0  # m, degrees, of a map: beyond them no film, or a wrong unit or pixel


class Measured:
    """Base of :class:`tehl_taichi.scene.feature.Feature`; all of it is for shape "map"."""

    def take_map(self):
        """Read the heights, or find those of the sha256; the file's place is kept whole."""
        if self.file:
            object.__setattr__(self, "file", os.path.abspath(self.file))
        sha256, heights = height_map.fetch(self.file, self.sha256)
        object.__setattr__(self, "sha256", sha256)
        self.__dict__["heights"] = heights
        self._check_keys_of_map()
        self._check_heights()

    def _check_keys_of_map(self):
        if not self.unit:
            raise SceneError(f"feature.unit is missing: shape 'map' needs the unit of the heights in its file; allowed: "
                             f"{', '.join(UNITS)} (feature.height, m per unit of the file in version 0.1.0, is not used)")
        if self.pixel == 0:
            raise SceneError("feature.pixel is missing: shape 'map' needs the distance of its points in m, as pixel = 1e-6")
        if self.height not in (0, type(self).height):
            raise SceneError(f"feature.height = {self.height:g} m says nothing about a map, whose heights are those of its "
                             "file in feature.unit; allowed: 0 or not given (feature.scale multiplies the heights)")
        object.__setattr__(self, "height", 0.0)
        for key, size, extent in zip(("extent_x", "extent_y"), self.size, self.patch):
            number(f"feature.{key}", extent, "m", 3 * self.pixel, size * (1 + 1e-9))

    def _check_heights(self):
        found, where = self.measures, f"feature.file = {self.file!r}, in {self.unit} with level = {self.level!r},"
        if found.range > MAX_RANGE:
            raise SceneError(f"{where} ranges over {found.range:.3g} m; allowed: at most {MAX_RANGE:g} m. Is feature.unit = "
                             f"{self.unit!r} right?")
        if found.slope > MAX_SLOPE:
            raise SceneError(f"{where} has slopes of {found.slope:.1f} deg; allowed: at most {MAX_SLOPE:g} deg. Are "
                             f"feature.unit = {self.unit!r} and feature.pixel = {self.pixel:g} m right?")

    def __setstate__(self, state):
        """A copy in another process brings its heights along."""
        self.__dict__.update(state)
        if self.shape == "map":
            self.__dict__["heights"] = height_map.keep(self.heights)[1]

    @cached_property
    def heights(self):
        """Heights (rows, columns) of a map in the unit of its file, as they were when the feature was made."""
        return height_map.fetch(self.file, self.sha256)[1]

    @cached_property
    def surface(self):
        """Heights (rows, columns) of a map in m, levelled and scaled: what passes through the contact."""
        return height_map.levelled(self.heights, self.level) * (UNITS[self.unit] * self.scale)

    @property
    def used(self):
        """The part of `surface` inside the patch."""
        rows, columns = self.surface.shape
        cut = [int((n - 1 - round(size / self.pixel)) // 2) for n, size in zip((columns, rows), self.patch)]
        return self.surface[cut[1]:rows - cut[1], cut[0]:columns - cut[0]]

    @cached_property
    def measures(self):
        """Range, rms and largest slope of the part of a map that is used."""
        return Measures.of(self.used, self.pixel)

    @property
    def size(self):
        """(length, width) of the whole map in m."""
        rows, columns = self.heights.shape
        return (columns - 1) * self.pixel, (rows - 1) * self.pixel
