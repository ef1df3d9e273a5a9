"""Scenes of the contacts of the most loaded element with both rings; body a is the ring, body b the element."""

import dataclasses
import math

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.bearing.dry_contact import LINE
from tehl_taichi.runs.flank.line_contacts import room
from tehl_taichi.scene import grid_for_features, idle_keys
from tehl_taichi.scene.aliases import BY_SURFACE, full_name
from tehl_taichi.scene.description import Scene
from tehl_taichi.values.coded_warning import unique

STEADY_GRID = {"grid.nx": 128, "grid.ny": 32}  # of steady contacts, unless the caller or the scene says otherwise
# beginnings of keys that say nothing of the ring without features
OF_PASSAGES = ("time.", "feature.", *(f"fatigue.{key}" for key in idle_keys.OF_A_PASSAGE))
SMALLEST = 1e-12  # of a slide-roll ratio that is rounding


def base_of(scene, feature=None):
    """Scene with the dent or scan `feature` as its only one (None: its own features); not checked before the contact is set."""
    data = scene.to_dict()
    data["time"]["steady_only"] = True
    if feature is not None:
        data["feature"] = [feature]
    return _with_material_of(scene, Scene.from_dict(data))


def check_free(changes):
    """Refuse changes of keys that the bearing determines. Raises SceneError."""
    for key in map(full_name, changes):
        if key.startswith("contact.") or key in ("operation.u_m", "operation.srr", *BY_SURFACE):
            raise SceneError(f"{key} has no effect: dimensions, load and speed of the bearing set it")


def idle_words(base, changes):
    """Warnings about keys of a passage in `changes` for steady contacts. Raises SceneError for wrong keys and values."""
    given = {full_name(key): value for key, value in changes.items() if full_name(key).startswith(OF_PASSAGES)}
    features = {key: value for key, value in given.items() if key.startswith("feature.")}
    others = {"time.steady_only": False, **{key: value for key, value in given.items() if key not in features}}
    found = [*idle_keys.doubts(base.replace(**features)), *idle_keys.doubts(smooth(base).replace(**others))]
    return unique(one for one in found if one.data["key"] in given)


def ring_scene(base, changes, name, contact, dry, u_m, srr, passes, choose=False):
    """(scene called `name` of one ring, text about its grid). Raises SceneError that names the ring.

    contact: its RingContact; dry: its DryContact; passes: whether features pass; choose: whether their grid is chosen here.
    """
    own = {"name": name, "contact.kind": dry.kind, "contact.radius_x": contact.R_x,
           "contact.radius_y": math.inf if dry.kind == LINE else contact.R_y, "contact.load": dry.scene_load,
           "operation.u_m": u_m, "operation.srr": srr if abs(srr) > SMALLEST else 0.0}
    given = {full_name(key): value for key, value in changes.items()}
    try:
        if not passes:
            return _steady(base, own, given), ""
        keys = {**own, **_room_of(base, given, contact, dry), **given}
        choice = grid_for_features.choose_for_changes(base, keys) if choose else grid_for_features.UNCHANGED
        return base.replace(**{**keys, **choice.keys, "time.steady_only": False}), choice.text
    except SceneError as error:
        raise SceneError(f"{contact.ring} ring: {error}") from None


def _steady(base, own, given):
    """Scene of a ring without features; own: keys of the ring, given: changes by the caller, {full key: value}."""
    kept = {key: value for key, value in given.items() if not key.startswith(OF_PASSAGES)}
    grid = {} if any(key.startswith("grid.") for key in kept) else STEADY_GRID
    return smooth(base).replace(**{**own, **grid, **kept, "time.steady_only": True})


def _room_of(base, given, contact, dry):
    """Keys of a larger domain for features in a line contact, without those that the caller gives; {} for a point contact."""
    wider = room(base.replace(**bodies(given)), dry.scene_load, contact.R_x) if dry.kind == LINE else {}
    return {key: value for key, value in wider.items() if key not in given}


def bodies(changes):
    """The changes that belong to the bodies."""
    return {key: value for key, value in changes.items() if key.startswith("bodies")}


def smooth(base):
    """Scene without its features."""
    return _with_material_of(base, dataclasses.replace(base, features=()))


def _with_material_of(base, made):
    """`made` with the record of the keys of oil and bodies that the user gave to `base`: it has another contact."""
    return made.with_user_keys((key for key in idle_keys.user_keys(base) if key.startswith(("oil.", "bodies."))), base.replaced)
