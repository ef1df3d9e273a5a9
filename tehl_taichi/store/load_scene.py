"""Load a scene by name, file or store, for the command line and Python (`tehl_taichi.scene`). Importing this is cheap."""

import os
from pathlib import Path
from typing import Any

from tehl_taichi.scene import BUILT_INS, Scene, SceneError
from tehl_taichi.scene.builtin import scene as built_in
from tehl_taichi.values.checks import text
from tehl_taichi.values.coerce import shown
from tehl_taichi.values.file_ending import ending


def find(name: Any = "gear") -> Scene:
    """Load a scene: see :func:`tehl_taichi.scene`."""
    return find_changed(name, {})


def find_changed(name, changes):
    """Load a scene with changes {key: value}, applied before its checks: a file that is invalid alone may need them. Raises
    SceneError.
    """
    from tehl_taichi.scene import scene_file

    name = getattr(name, "scene", name)  # of a Run
    if not isinstance(name, (str, os.PathLike, Scene)) or name == "":
        raise SceneError(f"{shown(name)} is not a scene; allowed: a Scene, a built-in name, a TOML file or a store")
    if not isinstance(name, Scene) and name not in BUILT_INS and _is_file(Path(name)):
        return scene_file.load(name, changes)
    found = name if isinstance(name, Scene) else _stored(Path(name)) or built_in(str(name))
    return found.replace(**changes) if changes else found


def named_in(file, data):
    """Name of the scene that a file of these keys names: a built-in one, or a scene file or store beside it; default: as for
    :func:`find`. Raises SceneError.
    """
    name = data.get("scene", "gear")
    text("scene", name)
    beside = Path(file).parent / name
    return str(beside) if name not in BUILT_INS and (ending(name) == ".toml" or os.path.exists(beside)) else name


def _is_file(path):
    return ending(path) == ".toml" or os.path.exists(path) and not os.path.isdir(path)


def _stored(path):
    """Scene of the store at `path`, None if no folder is there, or one with the name of a built-in scene. Raises StoreError for
    another folder.
    """
    from tehl_taichi.store import integrity

    if not os.path.isdir(path) or str(path) in BUILT_INS and not os.path.exists(path / "zarr.json"):
        return None
    return integrity.scene_of(path, integrity.root_of(path)[0])
