"""Grid that resolves the features of a scene, with a fine window if that takes less work."""

import contextlib
from typing import NamedTuple

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import idle_keys, resolution, zoom_room
from tehl_taichi.scene.resolution import ENOUGH, FEWEST
from tehl_taichi.scene.scales import Scales

WORK = 10.0  # of a passage over that on the grid of the scene, that is still chosen by itself: minutes in place of a minute
FACTORS = 0, 4, 8  # of a window; 0: none
# Work of a run with a window over that of the run: both windows start and are searched, and take as many nodes and steps as
# they are finer, on a PART of the passage, or on the WHOLE one where a hollow holds oil (tehl run gear --zoom 4: an asperity at
# SRR 0.12 four times, a dent at SRR -0.12 8.5 times)
AGAIN, PART, WHOLE, BESIDE = 2.0, 0.4, 0.75, (0.5, 0.3)  # BESIDE: a, of the window to each side of the features
AIMS = ENOUGH, 8, FEWEST  # cells of the smallest length
COLUMNS, ROWS = (128, 64), (32, 16)  # (least, multiple) of a grid that is chosen
KEYS = "grid.nx", "grid.ny", "zoom.factor"


class GridChoice(NamedTuple):
    """Keys {full key: value} of a chosen grid, and a text about it; {} and "" if the grid of the scene stays."""

    keys: dict
    text: str


UNCHANGED = GridChoice({}, "")


def is_grid_open(scene, changes=()):
    """Whether neither the scene nor changes of it (full keys) set the grid."""
    return not {key for key in {*idle_keys.user_keys(scene), *changes} if key in KEYS}


def choose_for_changes(base, keys):
    """The GridChoice for `base` with changes of these full keys: see :func:`choose_grid`."""
    steady = {key: value for key, value in keys.items() if not key.startswith("time.")} | {"time.steady_only": True}
    return choose_grid(base.replace(**steady))


def choose_grid(scene):
    """Choose a grid, or a grid and a window, that resolves every feature; return the GridChoice.

    UNCHANGED if the present grid resolves every feature, or if every sufficient grid takes more than WORK. Only the contact of
    the scene matters, not its passage.
    """
    sights = resolution.sights(scene, passing=True)
    if all(sight.cells >= ENOUGH for sight in sights):
        return UNCHANGED
    ways = ((aim, factor) for aim in AIMS for factor in FACTORS)
    found = (_grid_and_window(scene, sights, aim, factor) for aim, factor in ways)
    return next((choice for choice in found if choice), UNCHANGED)


def _grid_and_window(scene, sights, aim, factor):
    """The GridChoice with `aim` cells per length in a window `factor` times as fine (0: without a window); None if it takes
    more than WORK, or if the window does not fit.
    """
    cells = aim / max(factor, 1)
    ny = max(_count(scene, sights, "ny", cells, ROWS), 0 if factor else scene.grid.ny)
    widest = max(scene.grid.nx, _count(scene, sights, "nx", cells, COLUMNS))
    for nx in (widest, _count(scene, sights, "nx", cells, COLUMNS)):
        changes = {"grid.nx": nx, "grid.ny": ny, **({"zoom.factor": factor} if factor else {})}
        work = _window_work(scene, factor) * _work(nx, ny) / _work(scene.grid.nx, scene.grid.ny)
        if work <= WORK and _has_room(scene, changes):
            return GridChoice(changes, _words(scene, sights, changes, work))
    return None


def _count(scene, sights, key, cells, least):
    """Cells along an axis with `cells` of them per length of every feature."""
    own, (fewest, multiple) = getattr(scene.grid, key), least
    needed = max([fewest, *(own * cells / sight.cells for sight in sights if sight.count == key)])
    return int(-(-needed // multiple)) * multiple


def _window_work(scene, factor):
    """Work of a run with a window, relative to one without."""
    s, g = Scales.of(scene), scene.grid
    domain = (g.x_max - g.x_min) / 2, g.y_max * s.b / s.a
    shares = [min((max(f.reach, f.reach_y) / s.a + beside) / half, 1.0) for f in scene.features
              for half, beside in zip(domain, BESIDE)]
    part = WHOLE if zoom_room.holds_oil(scene) else PART
    return AGAIN + part * max(shares[::2]) * max(shares[1::2]) * factor**3 if factor else 1.0


def _work(nx, ny):
    """Nodes times steps; the number of steps is proportional to the columns."""
    return nx * nx * ny


def _has_room(scene, changes):
    with contextlib.suppress(SceneError):
        scene.replace(**changes, **{"time.steady_only": False})
        return True
    return False


def _words(scene, sights, changes, work):
    worst = min(sights, key=lambda sight: sight.cells)
    factor = max(changes.get("zoom.factor", 1), 1)
    cells = worst.cells * changes[f"grid.{worst.count}"] / worst.grid * factor
    window = f" with a window {factor} times as fine" if factor > 1 else ""
    return (f"grid {changes['grid.nx']}x{changes['grid.ny']}{window}: {cells:.0f} cells of {worst.key} = {worst.length:.3g} m "
            f"({worst.cells:.1f} on {scene.grid.nx}x{scene.grid.ny}); about {work:.2g} times the work; --grid chooses another")
