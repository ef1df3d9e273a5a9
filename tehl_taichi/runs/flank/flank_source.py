"""Find a flank by a built-in pair, a TOML file, a CSV table, or a GearPair."""

import dataclasses
import os
from dataclasses import dataclass

from tehl_taichi.errors import SceneError
from tehl_taichi.runs.flank import flank_columns, further_columns, load_table, positions, stored_flank
from tehl_taichi.runs.flank.mesh import Mesh
from tehl_taichi.scene import scene, toml_file
from tehl_taichi.scene.description import Scene
from tehl_taichi.scene.gear_pair import PAIRS, GearPair, gear_pair
from tehl_taichi.store.load_scene import find, named_in
from tehl_taichi.values.checks import build, file_name, text
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.file_ending import ending
from tehl_taichi.values.path_arguments import path_of

KEYS = ("name", "base", "gear", "table", "scene")
DEFAULT = 11  # positions


@dataclass(frozen=True)
class FlankSource:
    """Input of a flank. name: of the stores; pair: its gears, or None with the rows of a table; scene: everything but contact
    and speeds.
    """

    name: str
    scene: Scene
    pair: GearPair | None = None
    table: tuple = ()
    source: str = ""

    def __post_init__(self):
        file_name("name", self.name)

    def changed(self, torque=None, speed=None):
        """Copy with another torque (N m) and speed (1/min) of the pinion. Raises SceneError."""
        given = {key: value for key, value in (("torque", torque), ("n1", speed)) if value is not None}
        if not given:
            return self
        if not self.pair:
            raise SceneError(f"{self.name} is a table with its own loads and speeds; torque and speed apply to gear pairs only")
        return dataclasses.replace(self, pair=dataclasses.replace(self.pair, **given))

    def positions(self, on=None, count=None, at=()):
        """Positions on the flank of `on` (pinion by default): see
        :func:`tehl_taichi.runs.flank.positions.positions_along`; a table has
        fixed positions. Raises SceneError.
        """
        if count is not None and at:
            raise SceneError(f"positions = {shown(count)} and at = {shown(list(at))} contradict each other: give one of them")
        if self.pair:
            return positions.positions_along(Mesh(self.pair), on or "pinion", DEFAULT if count is None else count, at)
        for word, value in (("on", on), ("positions", count), ("at", at or None)):
            if value is not None:
                raise SceneError(f"{word} = {shown(value)} has no effect: the rows of a table define the positions, and body a "
                                 "carries the feature")
        return list(self.table)


def flank_source(what):
    """The FlankSource for a name, a path or a GearPair. Raises SceneError."""
    if isinstance(what, GearPair):
        return FlankSource("flank", scene(), what)
    if isinstance(what, str) and what in PAIRS:
        return FlankSource(what, scene(), gear_pair(what), source=PAIRS[what][1])
    path = path_of("gear", what)
    if ending(path) == ".csv":
        return FlankSource(path.stem, scene(), table=_rows(path), source=str(what))
    if ending(path) == ".toml" or os.path.exists(path):
        return _from_file(path)
    return FlankSource(str(what), scene(), gear_pair(str(what)))


def _rows(path):
    """Positions of a table. Raises SceneError."""
    places = tuple(load_table.load(path))
    further_columns.check(path, places, stored_flank.KEYS, flank_columns.COLUMNS)
    return places


def _from_file(path):
    """Read a flank file. Its keys: name; gear (a table, with `base` a built-in pair for missing values) or table (a CSV file);
    scene (a built-in one or a scene file); paths relative to this file.
    """
    data = toml_file.read(path, "flank", KEYS)
    if ("table" in data) == bool({"gear", "base"} & data.keys()):
        raise SceneError(f"{path} needs either a gear pair ([gear], base) or a table = \"file.csv\"")
    for key in {"table", "base"} & data.keys():
        text(key, data[key])
    given = dict(name=data.get("name", path.stem), scene=find(named_in(path, data)), source=str(path))
    if "table" in data:
        return FlankSource(**given, table=_rows(path.parent / data["table"]))
    base = dataclasses.asdict(gear_pair(data["base"])) if "base" in data else {}
    gear = data.get("gear", {})
    return FlankSource(**given, pair=build(GearPair, {**base, **gear} if isinstance(gear, dict) else gear, "gear"))
