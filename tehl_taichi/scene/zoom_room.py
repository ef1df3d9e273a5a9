"""Space and time for the zoom window around the features of a scene."""

import math

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.scales import Scales

WIDEST = 1.5  # a, of the features along x
BESIDE, CELLS = 0.05, 5  # a, and cells of the grid, at least, between the features and the end of the grid across

DEEP, SAMPLES = 0.01, 65  # depth of a hollow, over the largest height or depth of its feature; places looked at along an axis


def check(scene):
    """Refuse a scene whose features leave no space for its window, or a window that does not contain them. Raises
    SceneError.
    """
    extents = {axis: extent(scene, axis) for axis in ("xy" if scene.rows else "x")}
    _check_ends(scene, *extents.get("y", (0.0, 0.0)))
    low, high = extents["x"]
    if high - low > WIDEST:
        raise SceneError(f"{_zoom(scene)}: the features of surface {scene.reference.name} extend over {high - low:.3g} a along "
                         f"x; allowed: at most {WIDEST:g} a")
    for axis, (low, high) in extents.items():
        width = getattr(scene.zoom, f"width_{axis}")
        if width and width < high - low:
            raise SceneError(f"zoom.width_{axis} = {width:g} a is less than the features of surface {scene.reference.name}; "
                             f"allowed: at least {high - low:.3g} a, or 0 for what they change")


def _check_ends(scene, low, high):
    """Refuse a window whose sides along y are not on nodes of the grid."""
    if not math.isfinite(high - low):
        raise SceneError(f"{_zoom(scene)} needs features that end in y, or a line contact in which nothing varies along y")
    s, grid = Scales.of(scene), scene.grid
    edge = grid.y_max * s.b / s.a
    room = edge - CELLS * edge / grid.ny - BESIDE
    if (farthest := max(high, -low)) > room:
        raise SceneError(f"{_zoom(scene)}: the features of surface {scene.reference.name} reach to {farthest:.3g} a in y; "
                         f"allowed with grid.y_max = {grid.y_max:g}: at most {room:.3g} a")


def extent(scene, axis):
    """Extent (low, high), in a, of the features on the surface that a window follows, along an axis."""
    a = Scales.of(scene).a
    sides = [(getattr(f, axis), f.reach if axis == "x" else math.inf if f.transverse else f.reach_y)
             for f in scene.reference.features]
    return min((at - reach) / a for at, reach in sides), max((at + reach) / a for at, reach in sides)


def holds_oil(scene):
    """Whether features of the surface that a window follows have places below the smooth surface."""
    return any(heights.min() < -DEEP * np.abs(heights).max() for heights in map(_heights, scene.reference.features))


def _heights(f):
    """Heights (SAMPLES, SAMPLES or 1) m of a feature over its extent."""
    x = np.linspace(-f.reach, f.reach, SAMPLES)[:, None]
    y = np.linspace(-f.reach_y, f.reach_y, SAMPLES) if 0 < f.reach_y < np.inf else np.zeros(1)
    return f.height_at(x, y[None, :])


def _zoom(scene):
    return f"zoom.factor = {scene.zoom.factor}"
