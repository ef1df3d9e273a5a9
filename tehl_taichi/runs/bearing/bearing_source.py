"""Find a bearing by a designation, a TOML file, or its own dimensions."""

import dataclasses
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.bearing.designations import GROOVES, designation, key_of
from tehl_taichi.runs.bearing.rolling_bearing import BALL, RollingBearing
from tehl_taichi.scene import scene, toml_file
from tehl_taichi.scene.description import Scene
from tehl_taichi.values.checks import build, file_name, nearest, text
from tehl_taichi.values.coerce import plain, shown
from tehl_taichi.values.file_ending import ending
from tehl_taichi.values.path_arguments import path_of
from tehl_taichi.values.quantity import kinds

KEYS = ("name", "base", "bearing", "scene")  # of a file
SCENE = "gear"  # built-in scene that gives oil, bodies and numerics where none is named
OWN = ("diameter", "count", "pitch_diameter")  # a bearing that brings these needs no designation


@dataclass(frozen=True)
class BearingSource:
    """Input of a bearing. name: of the folder and the stores; bearing; source: of its dimensions, as text; estimated: keys that
    are not published; scene: oil, bodies and numerics, None if the caller has one.
    """

    name: str
    bearing: RollingBearing
    source: str
    estimated: tuple = ()
    scene: Scene | None = None

    def __post_init__(self):
        file_name("name", self.name)


def bearing_source(what, given):
    """The :class:`BearingSource` of a designation, a path or a RollingBearing; further keys `given` {key: value} take
    precedence. Raises SceneError.
    """
    given = {key: value for key, value in given.items() if value is not None}
    if isinstance(what, RollingBearing):
        changed = dataclasses.replace(what, **_known(given))
        return BearingSource("bearing", changed, "given")
    path = path_of("bearing", what)
    if ending(path) == ".toml":
        return _from_file(path, given)
    name, keys, source, estimated = _named(str(what), given)
    return _made(name, {**keys, **given}, source, estimated, given)


def _named(name, given):
    """(name, keys, source, estimated keys) of a designation; an unknown one needs given dimensions."""
    key = key_of(name)
    if not key and given.keys() >= set(OWN):
        return name, {}, "given", ()
    found = designation(name)
    return key, found.keys, found.source, found.estimated


def _made(name, keys, source, estimated, given, of_scene=None):
    made = build(RollingBearing, keys, "bearing")
    left = tuple(key for key in estimated if key not in given)
    if source == "given" and not made.rollers:
        left = tuple(key for key in GROOVES if key not in keys)
    return BearingSource(name, made, source, left, of_scene)


def _known(given):
    """Keys as values of a RollingBearing. Raises SceneError for an unknown key."""
    known = kinds(RollingBearing)
    for key in given:
        if key not in known:
            raise SceneError(f"unknown key bearing.{key}{nearest(key, known)}; known: {', '.join(known)}")
    return {key: plain(value) for key, value in given.items()}


def _from_file(path, given):
    """Read a bearing file. Its keys: name; bearing (a table, with `base` a designation for missing values); scene (a built-in
    one or a file beside this one).
    """
    data = toml_file.read(path, "bearing")
    for key in data:
        if key not in KEYS:
            raise SceneError(f"unknown key {shown(key)} in {path}{nearest(key, KEYS)}; known: {', '.join(KEYS)}")
    own = data.get("bearing", {})
    if not isinstance(own, dict) or not (own or "base" in data):
        raise SceneError(f"{path} needs a table [bearing], or base = a designation")
    base: dict = {}
    source, estimated = str(path), GROOVES if own.get("element", BALL) == BALL else ()
    if "base" in data:
        text("base", data["base"])
        found = designation(data["base"])
        base, source, estimated = found.keys, f"{path} on {data['base']}: {found.source}", found.estimated
    return _made(data.get("name", path.stem), {**base, **own, **given}, source, estimated, {**own, **given},
                 _scene_beside(path, data["scene"]) if "scene" in data else None)


def _scene_beside(path, named):
    """Scene that a bearing file names: a built-in one, or a file beside it."""
    from tehl_taichi.store.load_scene import find

    text("scene", named)
    beside = path.parent / named
    return find(str(beside) if beside.is_file() else named)


def default_scene():
    """Default scene for oil, bodies and numerics."""
    return scene(SCENE)
