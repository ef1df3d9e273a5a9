"""A scene by whatever names it on the command line."""

import os
from pathlib import Path

from tehl_taichi.io import intact, scene_file
from tehl_taichi.scene import BUILT_INS, Scene, SceneError, scene
from tehl_taichi.values.plain import shown


def find(name):
    """Scene by built-in name, TOML path, or store (the scene of that run); a Scene is itself. Raises SceneError, StoreError."""
    if isinstance(name, Scene):
        return name
    if not isinstance(name, (str, os.PathLike)):
        raise SceneError(f"{shown(name)} is no scene; allowed: a Scene, the name of a built-in one, a TOML file or a store")
    if name in BUILT_INS:
        return scene(str(name))
    path = Path(name)
    if path.is_dir() and (path / "zarr.json").exists():
        return intact.scene_of(path, intact.root_of(path)[0])
    if path.suffix == ".toml" or path.exists():
        return scene_file.load(path)
    return scene(str(name))
