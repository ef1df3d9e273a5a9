"""Changes of a scene, on its description as a nested dictionary."""

import dataclasses

from tehl_taichi.errors import SceneError
from tehl_taichi.scene import data_sheet, given
from tehl_taichi.scene import named_oils as oils
from tehl_taichi.scene.feature import SHAPES, USED_BY
from tehl_taichi.scene.named_steels import STEELS
from tehl_taichi.scene.route import ALL
from tehl_taichi.values.checks import key_shown, nearest


def applied(data, changes):
    """`data` (a scene as nested dictionary) with changes {full key: value}; what they replace is cleared. Raises SceneError."""
    _clear(data, changes)
    _name_oil(data, changes)
    _read_sheet(data["oil"], changes)
    _name_steels(data, changes)
    for key in sorted(changes, key=lambda key: key.count(".")):  # whole tables before single values
        _assign(data, key, changes[key])
    return data


def check_effect(scene, changes):
    """Refuse changes that the rest of the changed scene overrules or does not look at. Raises SceneError."""
    for key in changes:
        section, _, name = key.partition(".")
        if key in SPEEDS and scene.contact.moes_M > 0:
            raise SceneError(f"{given.words(key, changes[key])} has no effect: contact.moes_L = {scene.contact.moes_L:g} sets "
                             f"the mean speed, {scene.operation.u_m:.4g} m/s")
        if section == "oil" and name in scene.oil.unused - set(MOES if scene.contact.moes_M > 0 else ()):
            raise SceneError(f"{key} has no effect: the laws of this oil ({_laws_of(scene.oil)}) do not take it")
        if section == "feature" and name:
            number, _, name = name.partition(".")
            shape = scene.features[int(number)].shape
            if shape not in USED_BY.get(name, SHAPES):
                raise SceneError(f"feature.{name} has no effect on shape {shape!r}; it is of {', '.join(USED_BY[name])}")


SPEEDS = ("operation.u_m", *given.BY_SURFACE)


MOES = ("eta0", "alpha")  # numbers of the oil that a Moes pair uses


def _laws_of(oil):
    """The laws that it chose, with their numbers."""
    return "; ".join(f"{law.name}: {', '.join(law.numbers)}" for law in oil.laws[:2])


def _clear(data, changes):
    """Clear what the changes replace: another description of the load or of the speeds, a number of steps."""
    loads = [key for key in given.LOADS if changes.get(key)]
    if loads:
        pair = given.LOADS[2:]
        kept = pair if loads[0] in pair else loads
        data["contact"].update({key.partition(".")[2]: 0.0 for key in given.LOADS if key not in kept})
    if any(key in changes for key in given.BY_SURFACE):
        data["operation"] = {key: value for key, value in data["operation"].items() if key not in ("u_m", "srr")}
    if changes.get("time.steady_only"):
        data["time"]["steps"] = ALL


def _name_oil(data, changes):
    """A known name brings the numbers of its oil; a new one must come with numbers, or a data sheet."""
    name = changes.get("oil.name", data["oil"]["name"])
    if isinstance(name, str) and name in oils.OILS and "oil.name" in changes:
        data["oil"] = dataclasses.asdict(oils.OILS[name])
    elif name != data["oil"]["name"]:
        new = _of_oil(changes)
        if not data_sheet.speaks(new):
            oils.check_new(name, new)
            data["oil"].update(dict.fromkeys(data_sheet.KEYS, 0.0))
        data["oil"]["source"] = "" if data_sheet.speaks(new) else oils.NO_SOURCE


def _of_oil(changes):
    return {key.partition(".")[2]: value for key, value in changes.items() if key.startswith("oil.")}


def _read_sheet(oil, changes):
    """A data sheet makes another oil of one that had none; what follows from it is found anew, its source, too, unless that is
    the user's own."""
    new = _of_oil(changes)
    sheet = {**{key: oil[key] for key in data_sheet.KEYS}, **new}
    if data_sheet.speaks(sheet) and not data_sheet.speaks(oil):
        oil.update(name=changes.get("oil.name", data_sheet.NAME), viscosity=data_sheet.LAW, source="")
    elif data_sheet.KEYS.keys() & new.keys() and (oil["source"].startswith(data_sheet.FROM) or oil["name"] in oils.OILS):
        oil["source"] = "" if data_sheet.speaks(sheet) else oils.NO_SOURCE
    oil.update(dict.fromkeys(data_sheet.follows(sheet)))


def _name_steels(data, changes):
    """A known name brings the numbers of its steel."""
    for which, body in data["bodies"].items():
        name = changes.get(f"bodies.{which}.material")
        if isinstance(name, str) and name in STEELS:
            body.update(STEELS[name].numbers)


def _assign(data, dotted, value):
    """Set the dotted key in the nested dictionary."""
    *path, last = dotted.split(".")
    target = data
    if len(path) > 1 and path[0] == "feature" and path[1].isdecimal():
        features = data["feature"]
        if not isinstance(features, list) or len(path[1]) > 6 or int(path[1]) >= len(features):
            raise SceneError(f"{key_shown(dotted)}: scene {data['name']!r} has {len(features)} features")
        target, path = features[int(path[1])], path[2:]
    for key in path:
        if not isinstance(target, dict) or key not in target:
            raise SceneError(f"unknown key {key_shown(dotted)}{nearest(key, target if isinstance(target, dict) else ())}")
        target = target[key]
    known = list(target) if isinstance(target, dict) else []
    if target is data.get("operation"):
        known += ["u_a", "u_b", "u_m", "srr"]
    if last not in known:
        known += list(given.SHORT) if target is data else []
        raise SceneError(f"unknown key {key_shown(dotted)}{nearest(last, known)}; known: {', '.join(map(str, known))}")
    if last == "file":
        target["sha256"] = ""  # another file, other heights
    target[last] = value
