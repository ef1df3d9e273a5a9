"""Study files (TOML): a scene, changes common to all cases, and swept keys."""

import os
import tomllib
from pathlib import Path
from typing import Any

from tehl_taichi.disk import files
from tehl_taichi.errors import SceneError
from tehl_taichi.runs.sweep import axis_syntax
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import toml_file
from tehl_taichi.scene.aliases import check_swept
from tehl_taichi.store.load_scene import find_changed, named_in
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.file_ending import ending

KNOWN = ("scene", "set", "over", "together", "samples", "seed")


def is_study_file(path):
    """Whether a file is a study: scene files have no table [over] or [[together]]."""
    path = Path(path)
    if ending(path) != ".toml" or not os.path.isfile(path):
        return False
    try:
        return bool({"over", "together"} & tomllib.loads(files.text(path)).keys())
    except (OSError, ValueError, RecursionError):
        return False


def load(path):
    """Plan of a study file. Raises SceneError (also if the scene is refused).

    [over] has a line key = values for each key, [[together]] are tables of keys that change together, [set] holds changes of
    all cases; dotted keys may be quoted or not. scene: a built-in one, or a scene file beside this one.
    """
    path = Path(path)
    data = toml_file.read(path, "study", KNOWN)
    toml_file.check_brackets(path, data, one=("set", "over"), several=("together",))
    over: dict[Any, Any] = dict(_columns(data.get("over", {})))
    for group in data.get("together", []):
        columns = _columns(group)
        if tuple(columns) in over:
            raise SceneError(f"{', '.join(columns)} is swept twice in {path}: give all values in one table [[together]]")
        over[tuple(columns)] = _rows(columns)
    changes = _flat(data.get("set", {}))
    check_swept(changes, [key for keys in over for key in ((keys,) if isinstance(keys, str) else keys)])
    scene = find_changed(named_in(path, data), changes)
    return plan(scene, over, data.get("samples"), data.get("seed"))


def _flat(table, above=""):
    """{dotted key: value} of nested tables (TOML reads feature.height = 1 as a nested table)."""
    out: dict[str, Any] = {}
    for key, value in table.items():
        found = _flat(value, f"{above}{key}.") if isinstance(value, dict) else {above + key: value}
        for twice in out.keys() & found.keys():
            raise SceneError(f"{twice} is given twice, with quotes and without: {shown(out[twice])} and {shown(found[twice])}; "
                             "give it once")
        out |= found
    return out


def _columns(table):
    """{dotted key: its values} of a table of swept keys."""
    return {key: _listed(key, values) for key, values in _flat(table).items()}


def _listed(key, values):
    if not isinstance(values, (list, str)):
        raise SceneError(f"{key} = {shown(values)} must be a list of values or a range, as in \"-0.3:0.3:7\"")
    return values


def _rows(columns):
    return [list(row) for row in axis_syntax.axis(list(columns),
                                                  [axis_syntax.column(found) for found in columns.values()]).rows]
