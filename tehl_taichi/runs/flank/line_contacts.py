"""Scene of a position: its line contact, with everything else from the scene of the flank."""

import contextlib
import math

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import grid_for_features, hertz, overlap
from tehl_taichi.scene.aliases import BY_SURFACE, full_name
from tehl_taichi.scene.scales import reduced_modulus

AROUND = 2.0  # domain along y over the reach of the features: the contact is narrower towards A and E, the feature is not
SPARE = 1.2  # gap at the ends of the domain over the height of the features, which enter and leave there


def scene_at(base, changes, name, n, position):
    """Scene of the n-th position of a flank called `name`: `base` with `changes` (as for Scene.replace) and the contact at the
    position. Raises SceneError with the position.

    Temperatures are computed at all positions unless switched off, also for pure rolling at the pitch point, so that one table
    compares like with like.
    """
    with _errors_at(position):
        return base.replace(**_keys_at(base, changes, name, n, position))


def scene_with_grid_at(base, changes, name, n, position):
    """(scene of a position as in :func:`scene_at`, with a grid chosen for the features that pass; text about the grid)."""
    with _errors_at(position):
        keys = _keys_at(base, changes, name, n, position)
        choice = grid_for_features.choose_for_changes(base, keys)
        return base.replace(**keys, **choice.keys), choice.text and f"{where(position)}: {choice.text}"


@contextlib.contextmanager
def _errors_at(position):
    """Name the position in every SceneError."""
    try:
        yield
    except SceneError as error:
        raise SceneError(f"position {where(position)}: {error}") from None


def _keys_at(base, changes, name, n, position):
    """{full key: value} of all changes of `base` for a position. Raises SceneError for a key that the position determines."""
    given = {full_name(key): value for key, value in changes.items()}
    _check_free(given)
    plain = _without_passage(base, given)
    steady = given.get("time.steady_only", base.time.steady_only)
    own = _own(plain, name, n, position, "operation.temperature" in given)
    return {**own, **given, **({} if steady else room(plain, position.load, position.R))}


def _check_free(given):
    for key in given:
        if key.startswith("contact.") or key in ("operation.u_m", "operation.srr", *BY_SURFACE):
            raise SceneError(f"{key} has no effect: the gears or the table set it at every position")


def _without_passage(base, given):
    """Changed scene without its passage, to avoid checks of the features that depend on the contact."""
    return base.replace(**{key: value for key, value in given.items() if key != "time.steps"} | {"time.steady_only": True})


def _own(plain, name, n, position, warm):
    """Keys that a position sets in its scene; warm: a change (an option) sets the temperature."""
    heat = {} if position.bulk is None or warm else {"operation.temperature": position.bulk}
    return {**heat, "name": store_name(name, n, position), "contact.kind": "line", "contact.radius_y": math.inf,
            "contact.radius_x": position.R, "contact.load": position.load, "operation.u_m": position.u_m,
            "operation.srr": position.srr, "thermal.on": plain.thermal.on is not False}


def room(plain, load, R):
    """Keys of a larger domain for features that are large relative to a line contact (load in N/m, reduced radius R in m): the
    gap at its ends is higher than they are, and its width larger.
    """
    if not plain.features:
        return {}
    a, _ = hertz.line(load, R, reduced_modulus(plain))
    top = sum(overlap.highest_on(surface.features, a) for surface in plain.surfaces)
    end = hertz.gap_reaches(SPARE * top * R / a**2)
    reach, grid = max(abs(f.centre_y) + f.reach_y for f in plain.features), plain.grid
    side = min(AROUND * reach / a, 20.0) if math.isfinite(reach) else 0.0
    ends = {"grid.x_min": (-end, end), "grid.x_max": (end, end), "grid.y_max": (side, side)}
    return {key: value for key, (value, far) in ends.items() if far > abs(getattr(grid, key.partition(".")[2]))}


def store_name(name, n, position):
    """Name of a store, such as fzg-c-03-C."""
    return f"{name}-{n:02d}" + (f"-{position.point}" if position.point else "")


def where(position):
    """Text of a position."""
    return f"{position.point}{' ' * bool(position.point)}({position.words})"
