"""Residual stress along the surface: a number, or rows of depth and stress, linear between them and constant beyond."""

from pathlib import Path

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.values.checks import number

LARGEST = 5e9  # Pa


class Residual:
    """Function of the depth (m) that gives Pa. given: Pa, or rows (depth m, Pa), depths increasing from 0 or more.

    Raises SceneError where it is neither.
    """

    def __init__(self, given):
        if isinstance(given, (int, float)):
            number("residual", given, "Pa", -LARGEST, LARGEST)
            given = [(0.0, given)]
        try:
            table = np.array(given, float)
        except (TypeError, ValueError):
            table = np.zeros(0)
        if table.ndim != 2 or table.shape[1] != 2 or not np.isfinite(table).all():
            raise SceneError("residual must be a stress in Pa, or rows of two numbers: depth in m, stress in Pa")
        self.depth, self.stress = table.T
        if self.depth[0] < 0 or (np.diff(self.depth) <= 0).any():
            raise SceneError("the depths of the residual stress must increase, from 0 m or more")
        number("residual", float(self.stress[np.argmax(np.abs(self.stress))]), "Pa", -LARGEST, LARGEST)

    def __call__(self, depth):
        return np.interp(depth, self.depth, self.stress)


def read(text):
    """What `--residual` gives: a number in Pa, or the rows of a CSV file (depth in m, stress in Pa). Raises SceneError."""
    try:
        return float(text)
    except ValueError:
        pass
    path = Path(text)
    if not path.is_file():
        raise SceneError(f"--residual {text!r} is neither a stress in Pa nor a file")
    try:
        return np.loadtxt(path, delimiter=",", ndmin=2)
    except (ValueError, OSError) as error:
        raise SceneError(f"--residual {text}: {error}; wanted: lines of depth in m, stress in Pa") from None
