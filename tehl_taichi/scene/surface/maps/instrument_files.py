"""Files of instruments, read by SurfaceTopography and x3pio (the extra `topography`)."""

import importlib.util
import math

import numpy as np

from tehl_taichi.errors import SceneError, brief, extra
from tehl_taichi.scene.surface.maps.length_units import UNITS
from tehl_taichi.scene.surface.maps.stated_values import Stated
from tehl_taichi.values.file_ending import ending

UNKNOWN_FILE = ("CannotDetectFileFormat", "UnknownFileFormat")  # its errors that list every reader


def read(path, readable):
    """(numbers of the file as a table of text has them: a grid (rows, columns), or columns of places and heights of a line;
    what it says of its unit and distances). readable: endings of what is read without the extra, in words. SceneError."""
    if ending(path) == ".x3p" and importlib.util.find_spec("x3pio"):
        return _x3p(path)
    try:
        import SurfaceTopography
    except ImportError:
        raise SceneError(f"{path.name} does not end in {readable}; other formats need SurfaceTopography: "
                         f"{extra('topography')}") from None
    try:
        return _table(SurfaceTopography.read_topography(str(path)))
    except Exception as error:
        raise SceneError(f"cannot read heights from {path}: {_reader_error(error, readable)}") from None


def _x3p(path):
    """The same of an x3p file (ISO 25178-72), whose first layer counts; its numbers are m."""
    import x3pio

    try:
        found = x3pio.read(path)
        if not isinstance(found, (x3pio.Surface, x3pio.Profile)):
            return np.asarray(found.layers[0].points(), float), Stated("m", place_unit="m")
        heights = np.ma.filled(np.ma.asarray(found.layers[0].z, float), math.nan)
        steps = [(float(axis.increment),) if axis.is_incremental else () for axis in (found.header.x, found.header.y)]
    except Exception as error:
        raise SceneError(f"cannot read heights from {path}: {brief(error)}") from None
    return heights, Stated("m", steps[0], steps[1] if heights.ndim > 1 else ())


def _table(found):
    found = found if found.unit is None or found.unit in UNITS else found.to_unit("um")
    heights = np.ma.filled(np.ma.asarray(found.heights(), float), math.nan)
    if found.dim == 1:
        unit = found.unit or ""
        return np.column_stack([found.positions(), heights]), Stated(unit, place_unit=unit)
    return heights.T, _stated(found)


def _stated(found):
    """Of a grid; its sizes are nothing where no unit is known."""
    if found.unit is None:
        return Stated()
    sizes = found.physical_sizes or (0, 0)
    steps = ((size * UNITS[found.unit] / count,) if size else () for size, count in zip(sizes, found.nb_grid_pts))
    return Stated(found.unit, *steps)


def _reader_error(error, readable):
    """What a reader of instruments' files says; where none knows the file, all that it tried is of no use to anybody."""
    if type(error).__name__ in UNKNOWN_FILE:
        return f"SurfaceTopography does not read this format; export the heights as text ({readable})"
    return brief(error)
