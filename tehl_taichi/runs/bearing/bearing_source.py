"""Find a bearing by a designation, a TOML file, or its own dimensions."""

import dataclasses
import os
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.bearing.designations import GROOVES, designation, key_of, of_element
from tehl_taichi.runs.bearing.rolling_bearing import BALL, ROLLER, RollingBearing
from tehl_taichi.scene import toml_file
from tehl_taichi.scene.description import Scene
from tehl_taichi.store.load_scene import find, named_in
from tehl_taichi.values.checks import build, file_name, nearest, text
from tehl_taichi.values.coerce import plain
from tehl_taichi.values.file_ending import ending
from tehl_taichi.values.path_arguments import path_of
from tehl_taichi.values.quantity import kinds

KEYS = ("name", "base", "bearing", "scene")  # of a file
DUTY = ("clearance", "load", "axial", "speed", "outer_speed")  # no dimensions
COMMANDS = {BALL: "bearing", ROLLER: "roller"}
OWN = ("diameter", "count", "pitch_diameter")  # a bearing that brings these needs no designation


@dataclass(frozen=True)
class BearingSource:
    """Input of a bearing. name: of the folder and the stores; bearing; source: of its dimensions, as text; estimated: keys that
    are not published; changed: dimensions that are not those of the name; scene: oil, bodies and numerics, None if the caller
    has one.
    """

    name: str
    bearing: RollingBearing
    source: str
    estimated: tuple = ()
    changed: tuple = ()
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
    what = str(what) if isinstance(plain(what), int) else what  # 6206, the number of a designation
    path = path_of("bearing", what)
    if ending(path) == ".toml" or os.path.isfile(path) and not key_of(str(what)):
        return _from_file(path, given)
    return _named(str(what), given)


def _named(name, given):
    """The BearingSource of a designation; an unknown one needs given dimensions."""
    key = key_of(name)
    if not key and given.keys() >= set(OWN):
        made = build(RollingBearing, given, "bearing")
        return BearingSource(name, made, "given", () if made.rollers else _not_given(GROOVES, given))
    found = designation(name)
    _check_element(key, found.keys, given, of_element)
    made = build(RollingBearing, {**found.keys, **given}, "bearing")
    changed = _changed(found.keys, given, made)
    source = f"{as_given(key, changed)}; otherwise {_source(found, changed)}" if changed else _source(found)
    return BearingSource(key, made, source, _not_given(found.estimated, given), changed)


def _not_given(keys, given):
    return tuple(key for key in keys if key not in given)


def _source(found, changed=()):
    """Source of a Designation, with its rating unless dimensions are changed."""
    return "; ".join(filter(None, (found.source, "" if changed else found.rating, found.note)))


def _changed(keys, given, made):
    """Dimensions among the `given` keys of a bearing `made` that differ from these other keys."""
    return tuple(key for key in given if key not in DUTY and getattr(made, key) != keys.get(key, getattr(RollingBearing, key)))


def as_given(name, changed):
    """Name of a bearing, with its changed dimensions."""
    return f"{name}, with {' and '.join(changed)} as given" if changed else name


def _check_element(name, keys, given, others=lambda element: ()):
    """Refuse rollers for a ball bearing, and balls for a roller bearing; others: bearings with such elements. SceneError."""
    own = keys.get("element", BALL)
    if (sought := given.get("element", own)) != own:
        known = ", ".join(others(sought))
        raise SceneError(f"{name} is a {own} bearing, not a {sought} bearing; use `tehl {COMMANDS.get(own, own)} {name}`"
                         f"{f' (known with {sought}s: {known})' if known else ''}")


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
    data = toml_file.read(path, "bearing", KEYS)
    own = data.get("bearing", {})
    if not isinstance(own, dict) or not (own or "base" in data):
        raise SceneError(f"{path} needs a table [bearing], or base = a designation")
    base: dict = {}
    found = None
    if "base" in data:
        text("base", data["base"])
        found = designation(data["base"])
        base = found.keys
    _check_element(path, {**base, **own}, given)
    made = build(RollingBearing, {**base, **own, **given}, "bearing")
    estimated = found.estimated if found else () if made.rollers else GROOVES
    source = f"{path} on {data['base']}: {_source(found, _changed(base, {**own, **given}, made))}" if found else str(path)
    return BearingSource(data.get("name", path.stem), made, source, _not_given(estimated, {**own, **given}),
                         _changed({**base, **own}, given, made),
                         find(named_in(path, data)) if "scene" in data else None)
