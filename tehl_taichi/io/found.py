"""A scene by whatever names it on the command line."""

from pathlib import Path

from tehl_taichi.io import intact, scene_file
from tehl_taichi.scene import BUILT_INS, scene


def find(name):
    """Scene by built-in name, TOML path, or store (the scene of that run). Raises SceneError."""
    if name in BUILT_INS:
        return scene(name)
    path = Path(name)
    if path.is_dir() and (path / "zarr.json").exists():
        return intact.scene_of(path, intact.root_of(path)[0])
    if path.suffix == ".toml" or path.exists():
        return scene_file.load(path)
    return scene(name)
