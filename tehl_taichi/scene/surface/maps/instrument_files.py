"""Files of instruments, read by SurfaceTopography (the extra `topography`)."""

import math

import numpy as np

from tehl_taichi.errors import SceneError, brief, extra

UNKNOWN_FILE = ("CannotDetectFileFormat", "UnknownFileFormat")  # its errors that list every reader


def heights(path, readable):
    """Numbers of the file as a table of text has them: a grid (rows, columns), or columns of places and heights of a line.
    readable: endings of what is read without the extra, in words. Raises SceneError."""
    try:
        import SurfaceTopography
    except ImportError:
        raise SceneError(f"{path.name} does not end in {readable}; other formats need SurfaceTopography: "
                         f"{extra('topography')}") from None
    try:
        return _table(SurfaceTopography.read_topography(str(path)))
    except Exception as error:
        raise SceneError(f"cannot read heights from {path}: {_reader_error(error, readable)}") from None


def _table(found):
    heights = np.ma.filled(np.ma.asarray(found.heights(), float), math.nan)
    return np.column_stack([found.positions(), heights]) if found.dim == 1 else heights.T


def _reader_error(error, readable):
    """What a reader of instruments' files says; where none knows the file, all that it tried is of no use to anybody."""
    if type(error).__name__ in UNKNOWN_FILE:
        return f"SurfaceTopography does not read this format; export the heights as text ({readable})"
    return brief(error)
