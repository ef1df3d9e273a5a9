"""Conversion of texts with a unit to numbers in the declared units, wherever a scene or a change is made."""

import dataclasses

from tehl_taichi.scene import keys
from tehl_taichi.scene.sections import Contact, Operation
from tehl_taichi.values.quantity import Number, kinds

BY_SURFACE = {f"operation.{key}": kinds(Operation)["u_m"] for key in ("u_a", "u_b")}
EITHER = "N/m or N"  # unit that the kind of contact decides, which is known where the section is made
DECLARED = {f"{section}.{key}": kind for section, cls in keys.CLASSES.items() for key, kind in kinds(cls).items()
            if isinstance(kind, Number) and kind.unit != EITHER} | BY_SURFACE


def in_units(value, key=""):
    """Value of a full key (a table, a list of features, a single value; "": a whole scene) with numbers in place of texts with
    a unit. Raises SceneError for a wrong unit.
    """
    if isinstance(value, dict) and key.count(".") < 2:
        return {name: in_units(one, f"{key}.{name}" if key else name) for name, one in value.items()}
    if isinstance(value, (list, tuple)) and key == "feature":
        return [in_units(one, key) if isinstance(one, dict) else one for one in value]
    kind = DECLARED.get(_without_number(key)) if isinstance(value, (str, list, tuple)) else None
    return kind.taken(key, value) if kind else value


def column_in_units(scene, key, values):
    """Values of a sweep for a full key of a scene, converted if they are a list. Raises SceneError."""
    if key == "contact.load":
        kind = dataclasses.replace(kinds(Contact)["load"], unit=scene.load_unit)
    else:
        kind = DECLARED.get(_without_number(key))
    return [kind.taken(key, value) for value in values] if kind and isinstance(values, list) else values


def _without_number(key):
    """Key without the number of the feature: feature.height for feature.0.height."""
    section, _, rest = key.partition(".")
    number, _, own = rest.partition(".")
    return f"feature.{own}" if section == "feature" and number.isdecimal() else key
