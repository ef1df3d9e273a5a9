"""Measured height maps: reading, levelling, measuring. Rows run along y, columns along x.

Heights are identified by the sha256 of their numbers, not by their file name. So a changed file does not change a feature that
was made from it, and a store that holds the heights needs no file.
"""

import hashlib
import math
import os
import weakref
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tehl_taichi.disk import memory_limit, npy
from tehl_taichi.errors import SceneError, brief
from tehl_taichi.scene.surface.maps import coordinates, instrument_files, line_profiles, text_heights
from tehl_taichi.scene.surface.maps.stated_values import Stated
from tehl_taichi.values.arrays import floats
from tehl_taichi.values.checks import why_absent
from tehl_taichi.values.file_ending import ending

ROWS = "rows"
LEVELS = {"none": "nothing", "mean": "mean", "plane": "plane", "form": "plane and curvature",  # level: what it removes
          ROWS: "plane and median of each row"}
_known: weakref.WeakValueDictionary[str, Any] = weakref.WeakValueDictionary()  # sha256 -> heights, while a feature holds them
_facts: dict[tuple[str, str], Any] = {}  # (file, sha256) -> its Facts
TEXT = (".csv", ".txt", ".asc", ".xyz")  # endings of files of text



@dataclass(frozen=True)
class Facts:
    """Facts of a file besides its heights; empty without a file (a store, an array). skipped: description of skipped parts;
    spacing: distances (along a row, from row to row) of its coordinates, None without any; stated: its unit and distances in m;
    falling: whether its coordinates fall (along a row, from row to row).
    """

    skipped: str = ""
    spacing: tuple = (None, None)
    stated: Stated = Stated()
    falling: tuple = (False, False)


def keep(values):
    """Register heights under their hash as long as the caller holds them. values: (rows, columns). Returns (sha256,
    heights).
    """
    values = np.array(values, "<f8", order="C")
    values.setflags(write=False)
    digest = hashlib.sha256(repr(values.shape).encode() + values.tobytes()).hexdigest()
    return digest, _known.setdefault(digest, values)


def fetch(file, sha256=""):
    """(sha256, heights in the unit of the file) of a file, or of heights registered under `sha256`.

    Raises SceneError if the file does not exist, is no regular grid of at least 4 x 4 numbers, lacks too many of them, or if
    its heights do not match `sha256`.
    """
    known = _known.get(sha256)
    if known is not None:
        return sha256, known
    table = table_of(file)
    found, values = keep(table.values)
    _facts[str(file), found] = Facts(table.skipped, table.spacing, table.stated, table.falling)
    if sha256 and found != sha256:
        raise SceneError(f"feature.file = {file!r} has changed since this scene was made (feature.sha256 = {sha256[:12]}..., "
                         f"not {found[:12]}...); remove feature.sha256 to use the present file")
    return found, values


def of_array(values):
    """(sha256, heights) of heights in memory, nan where they are masked. Raises SceneError if they are no grid of heights."""
    values = floats("heights", values, "an array of real numbers")
    values = line_profiles.in_one_row(values)
    if not is_profile(values) and (values.ndim != 2 or min(values.shape) < 4):
        raise SceneError(f"heights have the shape {values.shape}; allowed: (rows, columns), at least 4 x 4, or a line profile "
                         f"of at least {line_profiles.FEWEST} points")
    return keep(values)


def facts(f):
    """The :class:`Facts` of the file of a feature."""
    return _facts.get((str(f.file), f.sha256), Facts())


def named(f):
    """Name of the heights of a feature in a sentence: their file, or the array that they were given in."""
    return f"feature.file = {f.file!r}" if f.file else "the array of heights"


def table_of(file):
    """Heights as a :class:`tehl_taichi.scene.surface.maps.text_heights.Table`, which lists skipped parts; its values (rows,
    columns) are in the unit of the file, nan for unmeasured points. Raises SceneError.
    """
    path = Path(file)
    if not file:
        raise SceneError("feature.file is missing: shape 'map' needs a file of heights (.csv, .txt, .asc, .npy)")
    if not os.path.isfile(path):
        raise SceneError(f"feature.file = {str(file)!r} {why_absent(file)}")
    table = _load(path)
    profile = line_profiles.heights_of(table.values) is not None
    found = table.of_points() if not profile and coordinates.is_narrow(table.values) else None
    if found is None and not profile and coordinates.is_list(table.values):
        raise SceneError(f"feature.file = {str(file)!r} is a list of points that lie on no regular grid; export the heights as "
                         f"a grid, one row per line ({', '.join(TEXT)}, .npy)")
    if not (profile or found) and (rising := coordinates.uneven(table.values)):
        raise SceneError(f"feature.file = {str(file)!r} has a first {rising} beside an empty corner: coordinates at uneven "
                         "distances. Export the heights at even distances or without coordinates (heights need a number in the "
                         "corner)")
    table = found or table.without_coordinates()
    values = table.values
    if not is_profile(values) and (values.ndim != 2 or min(values.shape) < 4):
        raise SceneError(f"feature.file = {str(file)!r} must hold a grid of at least 4 x 4 heights, or a line profile of "
                         f"{line_profiles.FEWEST}, not numbers of shape {values.shape}")
    return table


def is_profile(values):
    """Whether heights (rows, columns) are a line profile: one row."""
    return values.ndim == 2 and values.shape[0] == 1 and values.shape[1] >= line_profiles.FEWEST


def _load(path):
    # 2 letters a number, 3 copies
    memory_limit.check(12 * path.stat().st_size * (ending(path) in TEXT), f"{path}, read as heights,")
    try:
        if ending(path) == ".npy":
            values = npy.load(path)
            if values.dtype.kind not in "fiu":
                raise ValueError(f"it holds {values.dtype}, not numbers")
            if values.ndim not in (1, 2):
                raise ValueError(f"it holds an array of {values.ndim} dimensions; allowed: 2 (rows, columns), or 1")
            return text_heights.Table(np.atleast_2d(values.astype(float)))
        if ending(path) in TEXT:
            return text_heights.read(path)
    except (ValueError, OSError, EOFError) as error:
        raise SceneError(f"cannot read heights from {path}: {brief(error)}") from None
    return text_heights.Table(*instrument_files.read(path, f"{', '.join(TEXT)} or .npy"))


def levelled(values, level):
    """Heights without the part that `level` (a key of LEVELS) removes, by least squares; form: all second-order terms."""
    if level == "none":
        return values
    centred = values - values.mean()
    if level == "mean":
        return centred
    y, x = (np.arange(n) - (n - 1) / 2 for n in values.shape)
    flat = centred - _line(values.mean(axis=0), x) - _line(values.mean(axis=1), y)[:, None]
    return flat if level == "plane" else flat - _second_order(flat, x, y)


def _line(profile, x):
    """Straight line through a profile; zero for one point."""
    return x * (x @ profile) / max(x @ x, 0.5)


def _second_order(values, x, y):
    """Part of heights (rows, columns; without a plane) that is x^2, y^2 or x y; each term is independent of the others."""
    twist = (y @ values @ x) / max((x @ x) * (y @ y), 0.25)
    return _parabola(values.mean(axis=0), x)[0] + _parabola(values.mean(axis=1), y)[0][:, None] + twist * np.outer(y, x)


def _parabola(profile, x):
    """(parabola of a profile without slope, its second derivative)."""
    bent = x * x - (x * x).mean()
    share = (bent @ profile) / (bent @ bent) if x.size > 2 else 0.0
    return share * bent, 2 * share


def curvature(values, steps):
    """Curvatures (along x, along y) of heights (rows, columns) in m with these point distances (m): 1/m, positive if the middle
    is high.
    """
    flat = levelled(values, "plane")
    return tuple(-_parabola(flat.mean(axis=axis), np.arange(n) - (n - 1) / 2)[1] / step**2
                 for axis, n, step in zip((0, 1), values.shape[::-1], steps))


@dataclass(frozen=True)
class Measures:
    """Lowest and highest height, rms about their mean (m) and largest slope between neighbours (degrees)."""

    low: float
    high: float
    rms: float
    slope: float

    @classmethod
    def of(cls, heights, steps):
        """Measures of heights (rows, columns), m; steps: distances of points along x and along y (m)."""
        slope = math.degrees(math.atan(steepest(heights, steps)))
        return cls(float(heights.min()), float(heights.max()), float(heights.std()), slope)

    @property
    def range(self):
        return self.high - self.low


def steepest(heights, steps):
    """Largest gradient between neighbours: of four points that form a cell, the steepest side along x with the steepest along
    y, so that it does not depend on the direction of the axes; of a line, its steepest side.
    """
    along, across = (np.abs(np.diff(heights, axis=axis)) / step for axis, step in zip((1, 0), steps))
    if min(heights.shape) == 1:
        return float(max(along.max(initial=0.0), across.max(initial=0.0)))
    return float(np.hypot(np.maximum(along[:-1], along[1:]), np.maximum(across[:, :-1], across[:, 1:])).max())


def error_on_grid(heights, along, across):
    """Error (rms) of `heights` on a coarse grid, over their rms: every `along`-th point along x and `across`-th along y is kept
    (not necessarily whole numbers), and the rest interpolated linearly. Above 1 where that shows waves that are not there.

    It is the rms over grids that begin at each corner: a scan and its mirror image have equal errors.
    """
    rms = float(heights.std())
    missed = [float((heights - seen.T).var()) for rows in _from_both_ends(heights, along)
              for seen in _from_both_ends(rows.T, across)]
    return math.sqrt(sum(missed) / len(missed)) / rms if rms > 0 else 0.0


def _from_both_ends(values, step):
    """[rows of `values` interpolated from points `step` apart] that begin at the first and at the last point."""
    if step <= 1 or values.shape[1] == 1:
        return [values]
    return [_resampled(values, step), _resampled(values[:, ::-1], step)[:, ::-1]]


def _resampled(values, step):
    """Rows of `values` interpolated from points `step` apart; an incomplete last interval is unchanged. Rows shorter than one
    interval lie between two points, which see nothing of them.
    """
    count = int((values.shape[1] - 1) / step)
    if count == 0:
        return 0 * values
    whole = np.arange(int(count * step) + 1)
    coarse = _linear(values, np.minimum(np.arange(count + 1) * step, values.shape[1] - 1))
    out = values.copy()
    out[:, whole] = _linear(coarse, np.minimum(whole / step, count))
    return out


def _linear(values, at):
    """Rows of `values` at the positions `at` (in points), by linear interpolation."""
    low = np.minimum(at.astype(int), values.shape[1] - 2)
    return values[:, low] * (1 - (at - low)) + values[:, low + 1] * (at - low)
