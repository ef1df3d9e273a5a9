"""Scene of a store whose law is not installed, with a law of the package in its place: results can be shown, not computed."""

import json

from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.sections import Fatigue, Rheology
from tehl_taichi.store import integrity
from tehl_taichi.values.quantity import kinds

# key of a choice that figures and tables of stored results do not use: its section
REPLACED = {"rheology.law": Rheology, "oil.viscosity": Oil, "oil.density": Oil, "fatigue.criterion": Fatigue,
            "fatigue.relation": Fatigue}


def scene_of(path, attrs):
    """(scene, description of what is missing or "") of a store. Raises StoreError if it cannot be read, or if a shape or
    hardening law that figures need is missing.
    """
    try:
        return integrity.scene_of(path, attrs), ""
    except StoreError:
        if not (fault := integrity.missing_choice(attrs["scene"])) or fault.partition(" ")[0] not in REPLACED:
            raise
        found = _with_replaced(path, attrs)
        if found is None:
            raise
        return found, (f"{path} was made with {fault}. Its results can be shown and plotted; computing with it needs the file "
                       "of this entry (TEHL_PLUGINS)")


def _with_replaced(path, attrs):
    """Scene with the defaults of its sections in place of every missing choice; None if it cannot be read."""
    data = json.loads(attrs["scene"])
    for _ in REPLACED:  # several may be missing
        key = integrity.missing_choice(json.dumps(data)).partition(" ")[0]
        if key not in REPLACED:
            break
        _replace(data, key)
    try:
        return integrity.scene_of(path, {**attrs, "scene": json.dumps(data)})
    except (StoreError, SceneError):
        return None


def _replace(data, key):
    """Remove a choice and the numbers that belong to it from its section, in place; defaults apply."""
    section, _, name = key.partition(".")
    known = kinds(REPLACED[key])
    data[section] = {one: value for one, value in data[section].items() if one in known and one != name}
