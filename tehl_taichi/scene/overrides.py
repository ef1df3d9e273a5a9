"""Changes of a scene in its form as a nested dictionary."""

import dataclasses
import math

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import aliases, data_sheet, fatigue_limits, idle_keys, keys
from tehl_taichi.scene import named_oils as oils
from tehl_taichi.scene.named_steels import STEELS
from tehl_taichi.scene.speeds import of_surfaces
from tehl_taichi.scene.strength import scene_tables
from tehl_taichi.scene.tables import TABLES, as_changes
from tehl_taichi.scene.timeline import ALL
from tehl_taichi.values.checks import ALL_KEYS, key_shown, known_names, nearest
from tehl_taichi.values.coerce import plain, shown, text_of
from tehl_taichi.values.digits import number_of
from tehl_taichi.values.quantity import kinds

TOP = (*TABLES, "feature", "name", "note")


def apply_changes(data, changes):
    """Apply changes {full key: value} to `data` in place; returns it. Keys that they replace are removed. Raises SceneError.

    data: a scene as nested dictionary, which may lack sections and keys. Values of a wrong type are left for the checks of
    Scene.
    """
    _clear(data, changes)
    if isinstance(data.get("contact"), dict):
        _follow_kind(data["contact"], changes)
    _name_oil(data, changes)
    _read_sheet(_table(data, "oil"), changes)
    _name_steels(data, changes)
    fatigue_limits.clear_replaced(_table(data, "fatigue"), _of("fatigue", changes))
    for key in sorted(changes, key=lambda key: key.count(".")):  # whole tables before single values
        _assign(data, key, changes[key])
    return data


def merge(base, data):
    """Apply the tables of a scene file as changes to `base` (all values of a scene as nested dictionary). Raises SceneError."""
    known = {key: value for key, value in data.items() if key in TOP}
    return {**apply_changes(base, dict(as_changes(known))), **{key: data[key] for key in data.keys() - known.keys()}}


def _table(data, key):
    """Table with this key, created if missing; a temporary one if the value is no table."""
    found = data.setdefault(key, {})
    return found if isinstance(found, dict) else {}


def check_effect(scene, changes):
    """Refuse changes that other keys of the changed scene override, or that belong to another law or shape. Raises
    SceneError.
    """
    strange, changed = idle_keys.idle_warnings(scene), idle_keys.changed_keys(scene, changes)
    for key, _, value in keys.every(scene):
        if key in strange and key in changed:
            given = changes.get(key, value)
            raise SceneError(f"{aliases.words(idle_keys.short_key(key, scene), given)} has no effect: {strange[key]}")


def _clear(data, changes):
    """Remove the keys that the changes replace: another description of the load or the speeds, a number of steps."""
    loads = [key for key in aliases.LOADS if _is_given(changes.get(key))]
    if loads:
        pair = aliases.LOADS[2:]
        kept = pair if loads[0] in pair else loads
        _table(data, "contact").update({key.partition(".")[2]: 0.0 for key in aliases.LOADS if key not in kept})
    speeds = _table(data, "operation")
    if any(key in changes for key in aliases.BY_SURFACE):
        for key in ("u_m", "srr"):
            speeds.pop(key, None)
    elif {"operation.u_m", "operation.srr"} & changes.keys():
        data["operation"] = of_surfaces(data["operation"])
    if _is_given(changes.get("time.steady_only")):
        _table(data, "time")["steps"] = ALL


def _follow_kind(contact, changes):
    """Remove a radius along y that no longer applies to the new kind or radius along x; refuse a load in the unit of another
    kind. Raises SceneError.
    """
    before, kind = contact.get("kind", "line"), changes.get("contact.kind", contact.get("kind", "line"))
    if "contact.radius_y" not in changes and (kind != before or (kind == "point" and "contact.radius_x" in changes)):
        contact["radius_y"] = math.inf
    turned = kind != before and "line" in (kind, before)
    if turned and _is_given(contact.get("load")) and not changes.keys() & set(aliases.LOADS):
        units = ("N/m", "N") if before == "line" else ("N", "N/m")
        raise SceneError(f"contact.kind = {shown(kind)} needs a load of its own: that of the {before} contact is "
                         f"{shown(contact['load'])} {units[0]}; give contact.load in {units[1]}, or contact.hertz_pressure")


def _is_given(value):
    """Whether a value sets its key (not 0, false or None); values of a wrong type are refused later."""
    return bool(value) if value is None or isinstance(value, (int, float, str)) else True


def _name_oil(data, changes):
    """A known name supplies the numbers of its oil; a new name needs numbers or a data sheet."""
    oil = _table(data, "oil")
    name = changes.get("oil.name")
    if isinstance(name, str) and name in oils.OILS:
        data["oil"] = dataclasses.asdict(oils.OILS[name])
    elif "oil.name" in changes and name != plain(oil.get("name")):
        new = _of("oil", changes)
        if not data_sheet.has_sheet(new):
            oils.check_new(name, new)
            oil.update(dict.fromkeys(data_sheet.KEYS, 0.0))
        oil["source"] = "" if data_sheet.has_sheet(new) else oils.NO_SOURCE


def _of(section, changes):
    return {key.partition(".")[2]: value for key, value in changes.items() if key.startswith(f"{section}.")}


def _read_sheet(oil, changes):
    """A data sheet replaces an oil that had none: numbers and source that follow from it are derived again; a user's source
    stays.
    """
    new, source = _of("oil", changes), text_of(oil.get("source"))
    sheet = {**{key: oil.get(key, 0.0) for key in data_sheet.KEYS}, **new}
    if data_sheet.has_sheet(sheet) and not data_sheet.has_sheet(oil):
        oil.update(name=changes.get("oil.name", data_sheet.NAME), viscosity=data_sheet.LAW, source="")
    elif data_sheet.KEYS.keys() & new.keys() and (source.startswith(data_sheet.FROM) or oil.get("name") in tuple(oils.OILS)):
        oil["source"] = "" if data_sheet.has_sheet(sheet) else oils.NO_SOURCE
    if new:
        oil.update(dict.fromkeys(data_sheet.derived_keys(sheet)))


def _name_steels(data, changes):
    """A known name supplies the numbers of its steel."""
    for which in ("a", "b"):
        name = changes.get(f"bodies.{which}.material")
        if isinstance(name, str) and name in STEELS:
            _table(_table(data, "bodies"), which).update(STEELS[name].numbers)


def _assign(data, dotted, value):
    """Set the dotted key. Raises SceneError for an unknown section; the section checks its own keys."""
    *path, last = dotted.split(".")
    known = (*TOP, *aliases.SHORT)
    if not path and last not in known:
        raise _unknown(dotted, last, known, f"{ALL_KEYS}, and `tehl run --help` for short ones")
    target = _place(data, path, dotted) if path else data
    if last == "file":
        target["sha256"] = ""  # another file, other heights
    if dotted in scene_tables.ROWS_OF:
        target[scene_tables.ROWS_OF[dotted]] = ""
    target[last] = value


def _place(data, path, dotted):
    """Table that holds the keys with this path. Raises SceneError."""
    section, *rest = path
    if section == "feature" and rest and rest[0].isdecimal():
        target, rest = _feature(data, rest[0], dotted), rest[1:]
    elif section == "bodies" and rest and rest[0] in ("a", "b"):
        target, rest = _table(_table(data, section), rest[0]), rest[1:]
    elif section in TABLES:
        target = _table(data, section)
    else:
        raise _unknown(dotted, section, TABLES)
    if rest:
        raise _unknown(dotted, rest[0], ("a", "b") if section == "bodies" else target)
    return target


def _feature(data, number, dotted):
    """Table of a feature."""
    features = data.get("feature", [])
    if not isinstance(features, list) or len(number) > 6 or int(number) >= len(features):
        count = len(features) if isinstance(features, list) else 0
        raise SceneError(f"{key_shown(dotted)}: scene {data.get('name')!r} has {number_of(count, 'feature')}; add one in a "
                         "scene file, as [[feature]]")
    return features[int(number)] if isinstance(features[int(number)], dict) else {}


def _unknown(dotted, key, known, place=ALL_KEYS):
    """SceneError about a key that is none of the `known` names; place: text that says where all of them are."""
    meant = _with_section(dotted) or nearest(key, known)
    return SceneError(f"unknown key {key_shown(dotted)}{meant}; {known_names(known, place)}")


def _with_section(key):
    """Text ' (did you mean ...?)' with the full keys of a key given without its section, or nothing."""
    full = [f"{name}.{own}" for name, kind in keys.CLASSES.items() for own in kinds(kind) if own.lower() == str(key).lower()]
    return f" (did you mean {' or '.join(map(repr, full))}?)" if full else ""
