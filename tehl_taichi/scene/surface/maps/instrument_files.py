"""Instrument files, read by SurfaceTopography and x3pio (the extra `topography`)."""

import contextlib
import importlib.util
import io
import math
from typing import Any

import numpy as np

from tehl_taichi.errors import SceneError, brief, extra
from tehl_taichi.scene.surface.maps.length_units import UNITS
from tehl_taichi.scene.surface.maps.stated_values import Stated
from tehl_taichi.values.file_ending import ending

UNKNOWN_FILE = ("CannotDetectFileFormat", "UnknownFileFormat")  # errors of SurfaceTopography that list every reader


def read(path, readable):
    """Read an instrument file. Returns (numbers as in a text table: a grid (rows, columns), or columns of positions and heights
    of a line; the unit and distances that the file states).

    readable: description of endings that are read without the extra. Raises SceneError.
    """
    readers = [_x3p] * (ending(path) == ".x3p" and _installed("x3pio")) + [_topography] * _installed("SurfaceTopography")
    if not readers:
        raise SceneError(f"{path.name} does not end in {readable}; other formats need SurfaceTopography: {extra('topography')}")
    errors = []
    for reader in readers:  # some x3p files are read by one of them only
        try:
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):  # they print
                return reader(path)
        except Exception as error:
            errors.append(error)
    raise SceneError(f"cannot read heights from {path}: {_reader_error(errors[0], readable)}")


def _installed(name):
    try:
        return importlib.util.find_spec(name) is not None
    except ValueError:  # a module that was made in memory
        return True


def _x3p(path):
    """Heights of an x3p file (ISO 25178-72): its first layer, in m; with the coordinates where the file has those of each
    point.
    """
    import x3pio

    found = x3pio.read(path)
    layer = found.layers[0]
    if not layer.is_regular_grid:
        points = np.asarray(layer.points(), float).reshape(-1, 3)
        return points[:, ::2] if isinstance(found, x3pio.Profile) else points, Stated("m", place_unit="m")
    heights: Any = np.ma.filled(np.ma.asarray(layer.z, float), math.nan)
    x, y = ((float(axis.increment),) for axis in (found.header.x, found.header.y))
    return heights, Stated("m", x, y if heights.ndim > 1 else ())


def _topography(path):
    import SurfaceTopography

    try:
        return _table(SurfaceTopography.read_topography(str(path)), True)
    except ValueError as error:
        with contextlib.suppress(Exception):  # of a file without sizes, which it wants
            return _table(SurfaceTopography.read_topography(str(path), physical_sizes=(1.0, 1.0)), False)
        raise error


def _table(found, sized):
    """Numbers and stated values of a topography; sized: its sizes are meaningful."""
    found = found if found.unit is None or found.unit in UNITS else found.to_unit("um")
    heights: Any = np.ma.filled(np.ma.asarray(found.heights(), float), math.nan)
    unit = found.unit or ""
    if found.dim == 1:
        x = np.asarray(found.positions(), float)
        return np.column_stack([x, heights]), Stated(unit, _steps(unit, np.ptp(x), x.size - 1))
    sizes = found.physical_sizes if sized and found.physical_sizes else (0, 0)
    return heights.T, Stated(unit, *(_steps(unit, size, count) for size, count in zip(sizes, found.nb_grid_pts)))


def _steps(unit, size, count):
    """Distance in m of `count` intervals; () if the unit is not known."""
    return (float(size) * UNITS[unit] / count,) if unit and size and count else ()


def _reader_error(error, readable):
    """Error message of the reader of instrument files; its list of tried formats is left out."""
    if type(error).__name__ in UNKNOWN_FILE:
        return f"SurfaceTopography does not read this format; export the heights as text ({readable})"
    return brief(error)
