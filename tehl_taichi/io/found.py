"""A scene by whatever names it, on the command line and in Python: `tehl_taichi.scene` is this. Importing it costs nothing."""

import os
from pathlib import Path

from tehl_taichi.scene import BUILT_INS, Scene, SceneError
from tehl_taichi.scene.builtin import scene as built_in
from tehl_taichi.values.plain import shown


def find(name: str | os.PathLike | Scene = "gear") -> Scene:
    """Scene by the name of a built-in one (`tehl scenes` lists them), from a TOML file, or of the run in a store.

    A Scene is itself. Raises SceneError with the nearest name, or with what is wrong in the file; StoreError for a damaged
    store.

    >>> import tehl_taichi as tehl
    >>> fast = tehl.scene("gear").replace(srr=-0.12, **{"grid.nx": 128})
    >>> f"{fast.operation.u_a:.2f} m/s, {fast.grid.nx} cells"
    '7.99 m/s, 128 cells'
    """
    if isinstance(name, Scene):
        return name
    if not isinstance(name, (str, os.PathLike)):
        raise SceneError(f"{shown(name)} is no scene; allowed: a Scene, the name of a built-in one, a TOML file or a store")
    return built_in(name) if name in BUILT_INS else _from_file(Path(name))


def find_changed(name, changes):
    """The scene by its name with changes {full key: value}. They may be what a file needs: one that is refused by itself counts
    with them written into it. Raises SceneError."""
    from tehl_taichi.io import scene_file

    try:
        found = find(name)
    except SceneError:
        if not changes or not Path(name).is_file():
            raise
        found = scene_file.load(name, changes)
    return found.replace(**changes) if changes else found


def _from_file(path):
    """Scene of a store or a TOML file; what is neither was meant as a name."""
    from tehl_taichi.io import intact, scene_file

    if path.is_dir() and (path / "zarr.json").exists():
        return intact.scene_of(path, intact.root_of(path)[0])
    if path.suffix == ".toml" or path.exists():
        return scene_file.load(path)
    return built_in(str(path))
