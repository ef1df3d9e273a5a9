"""A scene by whatever names it on the command line."""

from pathlib import Path

from tehl_taichi.io import scene_file
from tehl_taichi.scene import BUILT_INS, scene


def find(name):
    """Scene by built-in name, TOML path, or store (the scene of that run). Raises SceneError."""
    if name in BUILT_INS:
        return scene(name)
    path = Path(name)
    if path.is_dir() and (path / "zarr.json").exists():
        from tehl_taichi.io.store import Store  # imports zarr

        return Store.open(path).scene
    if path.suffix == ".toml" or path.exists():
        return scene_file.load(path)
    return scene(name)
