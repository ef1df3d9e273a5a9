"""Orientation of a scan: from rows and columns of the file to y and x of the contact."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Orientation:
    """transpose: rows of the file lie along y, not x; mirror_x, mirror_y: then reverse the points along x or y."""

    transpose: bool = False
    mirror_x: bool = False
    mirror_y: bool = False

    def turned(self, values):
        """Oriented `values`: (points along y, along x) of (rows, columns), contiguous in memory so that sums are equal to those
        of an oriented file.
        """
        values = values.T if self.transpose else values
        return np.ascontiguousarray(values[::-1 if self.mirror_y else 1, ::-1 if self.mirror_x else 1])

    def in_file(self, shape, j, i):
        """(row, column), from 0, in a file of this shape, of the point j along y, i along x."""
        numbers = self.turned(np.arange(shape[0] * shape[1]).reshape(shape))
        return divmod(int(numbers[j, i]), shape[1])

    def swapped(self, pair):
        """Pair (along x, along y) from a pair of the file (along a row, from row to row)."""
        return tuple(pair)[::-1] if self.transpose else tuple(pair)

    @property
    def says(self):
        """Description of the orientation; "" if nothing is changed."""
        axes = [axis for axis, mirrored in (("x", self.mirror_x), ("y", self.mirror_y)) if mirrored]
        return ", ".join(["transposed"] * self.transpose + [f"mirrored along {' and '.join(axes)}"] * bool(axes))
