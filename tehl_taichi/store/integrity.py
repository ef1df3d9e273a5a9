"""Check that a folder is a complete store; describe the damage."""

import contextlib
import json
import os
import re
from pathlib import Path

from tehl_taichi import __version__
from tehl_taichi.disk import files
from tehl_taichi.disk.files import TEMPORARY
from tehl_taichi.disk.links import ROOT
from tehl_taichi.disk.locks import LOCK
from tehl_taichi.errors import SceneError, StoreError
from tehl_taichi.laws.choices import CHOICES
from tehl_taichi.laws.criteria import CRITERIA
from tehl_taichi.laws.hardening import HARDENINGS
from tehl_taichi.laws.hardness import RELATIONS
from tehl_taichi.scene.feature import SHAPES
from tehl_taichi.scene.sections import NEWER, SECTIONS
from tehl_taichi.store import attributes, sets_of_runs, stored_maps
from tehl_taichi.values.checks import near_file
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.escape import typed

FORMAT = 3  # 1: version 0.1, without checksums; 2: to 0.6.1, every entry of a field in folders of its own
CHECKPOINTS = ".checkpoints"
SEEKS = "seeks_window"  # attribute of a run that gets the window it needs: True until it is found, then EXTENDED or nothing
EXTENDED = "if extended"  # the passage was cut: the window of more of it may be another
OURS = {ROOT, f"{ROOT}.tmp", CHECKPOINTS, LOCK}  # .tmp: to version 0.8


def is_store(path):
    """Whether a store, complete or damaged, is at `path`."""
    try:
        return {"scene", "steps"} <= files.json_of(Path(path) / ROOT)["attributes"].keys()
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return False


def foreign_names(path):
    """Names in the folder of a store that do not belong to it."""
    return sorted(child.name for child in path.iterdir() if child.name not in OURS and not TEMPORARY.fullmatch(child.name)
                  and (child.is_symlink() or not _of_array(child)))


def _of_array(folder):
    """Whether a folder is that of an array, also of one that a killed process has begun: zarr first writes the metadata under
    another name.
    """
    if os.path.isfile(folder / ROOT):
        return True
    return os.path.isdir(folder) and all(part.name.endswith(".partial") for part in folder.iterdir())


def root_of(path):
    """(attributes, {name: metadata of an array}) of the store at `path`. Raises StoreError."""
    path = Path(path)
    try:
        root = files.json_of(path / ROOT)
        attrs = root["attributes"]
        arrays = root["consolidated_metadata"]["metadata"]
    except FileNotFoundError:
        why = f"it has no {ROOT}" if os.path.isdir(path) else f"the folder does not exist{near_file(path)}"
        raise _no_store(path, why) from None
    except OSError as error:
        raise StoreError(f"{path} is not a store of tehl run: {error.strerror or error}") from None
    except (ValueError, KeyError, TypeError, RecursionError):
        raise StoreError(f"{path} is not a store of tehl run: its {ROOT} is not that of a store") from None
    if not isinstance(attrs, dict) or "scene" not in attrs or not isinstance(arrays, dict):
        raise _no_store(path, f"its {ROOT} describes no scene", attrs)
    if any(name != Path(name).name for name in arrays):
        raise damage_error(path, "one of its arrays lies outside")
    return attrs, arrays


def _no_store(path, why, attrs=None):
    """Error about a folder that is no store; of other results of tehl it names the stores inside."""
    found = sets_of_runs.kind_of(path, attrs)
    return StoreError(sets_of_runs.refusal(path, found) if found else f"{path} is not a store of tehl run: {why}")


def scene_of(path, attrs):
    """Scene of a store. Raises StoreError."""
    try:
        data = _scene_data(attrs["scene"])
        if attrs.get("format", 1) == 1 and data["time"]["steps"] == 0:  # meant all in version 0.1
            data["time"]["steps"] = -1
        return stored_maps.scene_of(path, data)
    except (SceneError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        if fault := missing_choice(attrs["scene"]):
            raise StoreError(f"{path} needs {fault}") from None
        fault = error if type(error) in (SceneError, ValueError, StoreError) else "a key is missing or has a wrong value"
        raise StoreError(f"{path} is damaged: the scene in its {ROOT} cannot be read ({fault})") from None


def _scene_data(text):
    """Nested dictionary of a scene as stores keep it. Raises ValueError."""
    try:
        data = json.loads(text)
    except (TypeError, ValueError):
        raise ValueError(f"{shown(text)} is not JSON") from None
    if not isinstance(data, dict) or not SECTIONS.keys() - NEWER <= data.keys():
        raise ValueError("sections are missing")
    features = data.get("feature")
    if not isinstance(features, list) or not all(isinstance(one, dict) for one in features):
        raise ValueError(f"feature = {shown(features)} must be a list of tables")
    return data


def missing_choice(text):
    """Description of a law, criterion or shape of a scene (as JSON) that is not installed here, or ""."""
    try:
        data = json.loads(text)
        chosen = {**{key: (_entry(data, key), names) for key, names in CHOICES.items()},
                  "fatigue.criterion": (_entry(data, "fatigue.criterion"), CRITERIA),
                  "fatigue.relation": (_entry(data, "fatigue.relation"), RELATIONS)}
        more = [*(("feature.shape", (one.get("shape"), SHAPES)) for one in data["feature"]),
                *((f"bodies.{name}.hardening", (data["bodies"][name].get("hardening"), HARDENINGS)) for name in "ab")]
    except (TypeError, ValueError, KeyError, AttributeError):
        return ""
    for key, (name, known) in (*chosen.items(), *more):
        if isinstance(name, str) and name not in known:
            return f"{key} = {shown(name)}, which is not installed here; known: {', '.join(known)}"
    return ""


def _entry(data, key):
    section, _, name = key.partition(".")
    return data[section].get(name)


def check(path, attrs, arrays, scene, needed):
    """Refuse attributes and arrays that do not belong together. needed: {name: dimensions after time} of the arrays of every
    entry.
    """
    steps = attrs.get("steps")
    if not isinstance(steps, int) or isinstance(steps, bool) or steps < 1:
        raise damage_error(path, f"'steps', the number of its entries, is {steps!r}")
    if not isinstance(attrs.get("finished"), bool):
        raise damage_error(path, f"'finished' is {attrs.get('finished')!r}, neither true nor false")
    if fault := attributes.invalid_attribute(attrs, written_by(attrs) is None):
        raise damage_error(path, fault)
    grid = {"x": scene.grid.nx + 1, "y": scene.rows + 1}
    for name, dimensions in needed.items():
        needed = [steps] + [grid[key] for key in dimensions]
        shape = _shape(arrays.get(name))
        if shape is None:
            raise damage_error(path, f"it has no array {name!r}")
        if shape[: len(needed)] != needed:
            raise damage_error(path, f"{name} has the shape {shape}, but its scene and entries need {needed}")


def check_folders(path, names):
    """Refuse to continue a store without the folder of one of these arrays."""
    for name in names:
        if not os.path.isdir(path / name):
            raise damage_error(path, f"the folder of its array {name!r} is missing")


def _shape(metadata):
    try:
        return list(metadata["shape"])
    except (TypeError, KeyError):
        return None


def attribute(path, attrs, name):
    """JSON table of an attribute that resuming needs. Raises StoreError."""
    value = optional_value(attrs, name, {})
    if not value and attrs.get(name) != "{}":
        raise damage_error(path, f"its attribute {name!r} is missing or unreadable")
    return value


def optional_value(attrs, name, default):
    """JSON value of an attribute that only readers use; `default` if it is missing or of another type."""
    try:
        value = json.loads(attrs[name])
    except (KeyError, TypeError, ValueError, RecursionError):
        return default
    return value if isinstance(value, type(default)) else default


def written_by(attrs):
    """Description of the version that wrote a store, None if it is this one."""
    version, layout = attrs.get("version", "unknown"), attrs.get("format", 1)
    if version == __version__ and layout == FORMAT:
        return None
    return f"written by version {version} (layout {layout}), this is {__version__} (layout {FORMAT})"


def check_layout(path, attrs):
    """Refuse a layout that this version does not know: it may misread its arrays. Raises StoreError."""
    layout = attrs.get("format", 1)
    if isinstance(layout, bool) or not isinstance(layout, int) or layout < 1:
        raise damage_error(path, f"'format', its layout, is {shown(layout)}; allowed: 1 to {FORMAT}")
    if layout > FORMAT:
        raise StoreError(f"{path} was {written_by(attrs)}; allowed: layouts 1 to {FORMAT}. Install the version that wrote it, "
                         f"or a newer one; `tehl run {typed(path)} --out NEW` repeats the run")


@contextlib.contextmanager
def newer_version_errors(path, attrs):
    """Context manager: an error while reading a store of a newer version becomes a StoreError that says which version to
    install.
    """
    try:
        yield
    except StoreError:
        version = attrs.get("version")
        if version_numbers(version) <= version_numbers(__version__):
            raise
        raise StoreError(f"{path} was written by version {version}, this is {__version__}: install {version} or newer"
                         ) from None


def version_numbers(version):
    """Numbers of a version (without development suffixes and trailing zeros), () if it is none."""
    found = re.match(r"\d+(\.\d+)*", version if isinstance(version, str) else "")
    numbers = [int(part) for part in found[0].split(".")] if found else []
    while numbers and not numbers[-1]:
        numbers.pop()
    return tuple(numbers)


def check_version(path, attrs):
    """Refuse to continue a store of another version."""
    if version := written_by(attrs):
        raise StoreError(f"{path} was {version}: it can be read but not resumed; `tehl run {typed(path)} --out NEW` repeats "
                         "the run")


def damage_error(path, what):
    """The StoreError about damage `what` of a store."""
    return StoreError(f"{path} is damaged: {what}; `tehl run {typed(path)} --out NEW` repeats the run")
