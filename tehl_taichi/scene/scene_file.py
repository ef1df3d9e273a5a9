"""Scene files (TOML): reading with a base scene, writing with every value, the commented template."""

import contextlib
import dataclasses
import json
import math
import os
from pathlib import Path

from tehl_taichi.disk import user_files
from tehl_taichi.scene import (
    Scene,
    SceneError,
    aliases,
    idle_keys,
    named_oils,
    named_steels,
    overrides,
    replaced_keys,
    scene,
    toml_file,
)
from tehl_taichi.scene.description import SECTIONS, TOP
from tehl_taichi.scene.feature import Feature
from tehl_taichi.scene.oil import Oil
from tehl_taichi.scene.sections import Body, Fatigue
from tehl_taichi.scene.strength import scene_tables
from tehl_taichi.scene.unit_texts import in_units
from tehl_taichi.values import plugins
from tehl_taichi.values.checks import text
from tehl_taichi.values.file_ending import ending
from tehl_taichi.values.quantity import kinds

HEADER = """# A tehl_taichi scene. SI units (m, s, N, Pa, kg), temperatures in deg C; [grid] and [time] in half-widths.
# Text with another unit is allowed: radius_x = "3.8 mm", temperature = "343 K"."""
CARRIES = {"bodies.a": "Surface a carries the feature. ", "bodies.b": "The other surface. "}
COLUMN = 26  # where the comments of short lines begin


def load(path, changes=()):
    """Load a scene from a TOML file; `base = "gear"` supplies missing values. changes: {key: value} in place of those of the
    file. Raises SceneError (also for broken TOML).
    """
    path = Path(path)
    data = toml_file.read(path, "scene")
    plugins.use(data.pop(plugins.KEY, []), path)
    toml_file.check_brackets(path, data, ("contact", "bodies", "operation", "oil", *SECTIONS), ("feature",))
    return from_data(with_folder(data, path.absolute().parent), path.stem, changes)


def new(path, base):
    """Write the built-in scene `base` with every value, under the name of the file. Raises SceneError if that is not
    possible.
    """
    path = Path(path)
    check_new(path)
    user_files.text(path, dumps(scene(base).replace(name=path.stem)))


def check_new(path):
    """Raise SceneError if no new file can be written at `path`, or its name is not that of a TOML file: a built-in scene may
    have that name, and tables have others.
    """
    if ending(path) != ".toml":
        example = path.with_suffix(".toml") if path.name else "my.toml"
        raise SceneError(f"{path} must be the name of a TOML file, as in {example}")
    if os.path.lexists(path):
        raise SceneError(f"{path} exists already; choose another name")
    if not os.path.isdir(path.absolute().parent):
        raise SceneError(f"{path.absolute().parent} is not a folder")


def with_folder(data, folder):
    """Data with the paths of height maps and tables relative to `folder` made independent of the working directory."""
    features = data.get("feature", [])
    for feature in features if isinstance(features, list) else []:
        if isinstance(feature, dict) and isinstance(feature.get("file"), str) and feature["file"]:
            feature["file"] = str(folder / feature["file"])
    if isinstance(data.get("fatigue"), dict):
        data["fatigue"] |= scene_tables.with_folder(data["fatigue"], folder)
    return data


def from_data(data, name, changes=()):
    """Scene from a parsed file with changes {key: value}, applied before all checks. Raises SceneError."""
    base, changes, data = data.pop("base", None), aliases.resolve_named(dict(changes)), in_units(data)
    own = _tables(data)
    u_m = data["operation"].get("u_m") if isinstance(data.get("operation"), dict) else None
    described = _spelled_out(_on_base(base, {"name": name, **data}))
    before = _valid_alone(described) if changes else None
    found = Scene.from_dict(overrides.apply_changes(described, changes))
    overrides.check_effect(found, changes)
    if not changes.keys() & set(aliases.LOADS):
        _check_speed(found, u_m)
    before = before or found
    return replaced_keys.with_changes(before.with_user_keys(idle_keys.given_keys(before, own)), found, changes)


def _valid_alone(described):
    """Scene of a file before its changes, None if it needs them."""
    with contextlib.suppress(SceneError):
        return Scene.from_dict(described)


def _tables(data):
    """Copy of the tables of a file, before derived values are written into them."""
    lists = {key: [dict(one) if isinstance(one, dict) else {} for one in value] for key, value in data.items()
             if isinstance(value, list)}
    return lists | {key: {name: dict(one) if isinstance(one, dict) else one for name, one in value.items()}
                    for key, value in data.items() if isinstance(value, dict)}


def _on_base(base, data):
    """Nested dictionary of a scene: `data`, completed from its base."""
    if base is None:
        return {"feature": [], **data}
    text("base", base)
    return overrides.merge(scene(base).to_dict(), data)


def _spelled_out(data):
    """Data with all numbers that follow from oil and steel names, a data sheet and fatigue limits; so a change that removes
    these keeps the numbers.
    """
    for key, make in (("oil", named_oils.from_values), ("fatigue", Fatigue.from_values)):
        if key in data:
            data[key] = _every_number(make, data[key])
    if isinstance(data.get("bodies"), dict):
        data["bodies"] = {which: named_steels.with_steel_numbers(body) for which, body in data["bodies"].items()}
    return data


def _every_number(make, values):
    """Table of a section with every number; an invalid one is returned unchanged, because later changes may correct it."""
    try:
        return dataclasses.asdict(make(values))
    except SceneError:
        return values


def _check_speed(found, u_m):
    """Refuse a mean speed (m/s, or None) beside a Moes pair that gives another one (files written by tehl contain both)."""
    if u_m is not None and found.contact.moes_M > 0 and not math.isclose(u_m, found.operation.u_m, rel_tol=1e-6):
        raise SceneError(f"operation.u_m = {u_m:g} m/s and contact.moes_L = {found.contact.moes_L:g} contradict each other: "
                         f"the pair gives {found.operation.u_m:.4g} m/s; leave u_m out")


def dumps(description):
    """TOML text of a scene, every value with unit, range and meaning; reading it gives an equal scene."""
    data = description.to_dict()
    lines = [HEADER, *_commented((key, data[key], declared) for key, declared in TOP.items()), ""]
    for key in ("contact", "bodies.a", "bodies.b", "operation", "oil", "rheology"):
        table, kind = (data["bodies"][key[-1]], Body) if key in CARRIES else (data[key], {**SECTIONS, "oil": Oil}[key])
        lines += _table(f"[{key}]", table, kind, CARRIES.get(key, ""))
    for feature in data["feature"]:
        lines += _table("[[feature]]", feature, Feature)
    for key in SECTIONS:
        if key not in ("contact", "operation", "rheology"):
            lines += _table(f"[{key}]", data[key], SECTIONS[key])
    return "\n".join(lines)


def _table(head, values, kind, first=""):
    """Lines of a section with comments from its declarations (see tehl_taichi.values.quantity)."""
    about = first + (kind.__doc__ or "").partition("\n")[0]
    keys = ((key, values[key], declared) for key, declared in kinds(kind).items())
    return [f"{head:<{COLUMN}}  # {about}", *_commented(keys), ""]


def _commented(keys):
    """One line for each (key, value, declaration)."""
    return [f"{f'{key} = {toml_value(value)}':<{COLUMN}}  # {declared.sentence}" for key, value, declared in keys]


def toml_value(value):
    """TOML text of a value of a scene."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")  # JSON's escapes are TOML's
    if isinstance(value, (tuple, list)):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    if isinstance(value, float) and math.isinf(value):
        return "inf" if value > 0 else "-inf"
    if isinstance(value, float) and float(f"{value:g}") == value:
        short = f"{value:g}"
        return short if set(short) & set(".e") else short + ".0"
    return repr(value)
