"""Measured height maps: reading and levelling. Rows run along y, columns along x."""

from functools import lru_cache
from pathlib import Path

import numpy as np

from tehl_taichi.errors import SceneError


def check_file(file):
    """Refuse a file that is not there; what is in it is checked when it is read."""
    if not file:
        raise SceneError("feature.file is missing: shape 'map' needs a CSV or NPY file of heights")
    if not Path(file).is_file():
        raise SceneError(f"feature.file = {str(file)!r} does not exist")


@lru_cache(maxsize=8)
def read(file, level="none"):
    """Heights (rows, columns) in the unit of the file, levelled: nothing, the mean or a plane taken off.

    Raises SceneError when the file is no regular grid of at least 4 x 4 finite numbers.
    """
    values = _load(Path(file))
    if values.ndim != 2 or min(values.shape) < 4 or not np.isfinite(values).all():
        raise SceneError(f"feature.file = {str(file)!r} must hold a grid of at least 4 x 4 finite heights, not one of shape "
                         f"{values.shape} with {int((~np.isfinite(values)).sum())} missing values")
    return values - _trend(values, level)


def _load(path):
    try:
        if path.suffix == ".npy":
            return np.asarray(np.load(path, allow_pickle=False), float)
        if path.suffix in (".csv", ".txt", ".asc"):
            return np.loadtxt(path, delimiter="," if path.suffix == ".csv" else None, ndmin=2)
    except (ValueError, OSError) as error:
        raise SceneError(f"cannot read heights from {path}: {error}") from None
    return _surface_topography(path)


def _surface_topography(path):
    try:
        import SurfaceTopography
    except ImportError:
        raise SceneError(f"{path.name} is neither .csv nor .npy; other formats need: pip install "
                         "'tehl_taichi[topography]'") from None
    try:
        return np.asarray(SurfaceTopography.read_topography(str(path)).heights(), float).T
    except Exception as error:
        raise SceneError(f"cannot read heights from {path}: {error}") from None


def _trend(values, level):
    if level == "none":
        return 0.0
    if level == "mean":
        return values.mean()
    y, x = (q - q.mean() for q in np.mgrid[: values.shape[0], : values.shape[1]].astype(float))
    return values.mean() + x * (x * values).sum() / (x * x).sum() + y * (y * values).sum() / (y * y).sum()
