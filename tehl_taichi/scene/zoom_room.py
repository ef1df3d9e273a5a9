"""Space and time for the zoom windows around the features of a scene."""

import math

import numpy as np

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import timeline
from tehl_taichi.scene.scales import Scales

FEWEST = 3  # stored moments of a passage with a window: the steady start, and two between which it moves
WIDEST = 1.5  # a, of the features along x
BESIDE, CELLS = 0.05, 5  # a, and cells of the grid, at least, between the features and the end of the grid across

DEEP, SAMPLES = 0.01, 65  # depth of a hollow, over the largest height or depth of its feature; places looked at along an axis


def check(scene):
    """Refuse a scene whose features leave no space for its window, or a window that does not contain them. Raises
    SceneError.
    """
    if why := no_room(scene, scene.reference):
        raise SceneError(why)
    for surface, axis in ((surface, axis) for surface in followed(scene) for axis in _axes(scene)):
        (low, high), width = extent(scene, axis, surface), getattr(scene.zoom, f"width_{axis}")
        if width and width < high - low:
            raise SceneError(f"zoom.width_{axis} = {width:g} a is less than the features of surface {surface.name}; "
                             f"allowed: at least {high - low:.3g} a, or 0 for what they change")


def why_none(scene):
    """Reason why a scene has no window, whatever its factor; "" if it can have one."""
    if not scene.transient:
        return "nothing passes"
    found = timeline.entries(scene)
    return "" if found >= FEWEST else (f"a window needs at least {FEWEST} stored moments, this run has {found}; extend it "
                                       "(time.steps, `tehl resume`) or use a smaller output.every")


def followed(scene):
    """The surfaces (MovingSurface) whose features have a window of their own: that of the first feature first.

    The other one has none if its features leave no space for it (:func:`no_room`), or always lie where those of the first
    surface change the film.
    """
    first = scene.reference
    return (first, *(other for other in others(scene) if not no_room(scene, other) and not _inside(scene, other, first)))


def others(scene):
    """The surface, if any, that has passing features but not the first one."""
    return [surface for surface in scene.surfaces
            if surface.name != scene.reference.name and surface.features and not surface.stands]


def no_room(scene, surface):
    """Reason why the features of a surface leave no space for a window, or ""."""
    low, high = extent(scene, "x", surface)
    across = _no_room_across(scene, surface) if "y" in _axes(scene) else ""
    if across or high - low <= WIDEST:
        return across
    return (f"{_zoom(scene)}: the features of surface {surface.name} extend over {high - low:.3g} a along x; allowed: at most "
            f"{WIDEST:g} a")


def _no_room_across(scene, surface):
    """Reason why the sides of a window along y are not on nodes of the grid, or ""."""
    low, high = extent(scene, "y", surface)
    if not math.isfinite(high - low):
        return f"{_zoom(scene)} needs features that end in y, or a line contact in which nothing varies along y"
    s, grid = Scales.of(scene), scene.grid
    edge = grid.y_max * s.b / s.a
    room = edge - CELLS * edge / grid.ny - BESIDE
    if (farthest := max(high, -low)) <= room:
        return ""
    return (f"{_zoom(scene)}: the features of surface {surface.name} reach to {farthest:.3g} a in y; allowed with grid.y_max = "
            f"{grid.y_max:g}: at most {room:.3g} a")


def _axes(scene):
    return "xy" if scene.rows else "x"


def _inside(scene, other, first):
    """Whether all that the features of a surface change lies within what those of the first surface change, all the time."""
    if scene.zoom.width_x or scene.zoom.width_y:
        return False
    (low, high), (left, right) = changed(scene, other), changed(scene, first)
    ways = [(other.pace - 1.0) * at for at in scene.path]
    along = left <= low + min(ways) and high + max(ways) <= right
    return along and ("y" not in _axes(scene) or _inside_across(scene, other, first))


def _inside_across(scene, other, first):
    (low, high), (left, right) = (extent(scene, "y", surface) for surface in (other, first))
    return left <= low and high <= right


def extent(scene, axis, surface):
    """Extent (low, high), in a, of the features on a surface (MovingSurface), along an axis."""
    a = Scales.of(scene).a
    sides = [(getattr(f, axis), f.reach if axis == "x" else math.inf if f.transverse else f.reach_y) for f in surface.features]
    return min((at - reach) / a for at, reach in sides), max((at + reach) / a for at, reach in sides)


def changed(scene, surface):
    """Extent (low, high), in a, of the features on a surface along x, and of the oil that has passed over them: at most 2 a
    ahead or behind."""
    lead = 2.0 * (scene.operation.u_m / surface.speed - 1.0)
    low, high = extent(scene, "x", surface)
    return low + min(lead, 0.0), high + max(lead, 0.0)


def holds_oil(scene):
    """Whether features that windows follow have places below the smooth surface."""
    return any(heights.min() < -DEEP * np.abs(heights).max() for surface in followed(scene)
               for heights in map(_heights, surface.features))


def _heights(f):
    """Heights (SAMPLES, SAMPLES or 1) m of a feature over its extent."""
    x = np.linspace(-f.reach, f.reach, SAMPLES)[:, None]
    y = np.linspace(-f.reach_y, f.reach_y, SAMPLES) if 0 < f.reach_y < np.inf else np.zeros(1)
    return f.height_at(x, y[None, :])


def _zoom(scene):
    return f"zoom.factor = {scene.zoom.factor}"
