"""Plugins: user folders with laws, criteria, shapes, oils ..., in subfolders named as the package's (shear, shapes ...).

A plugin is a folder or the name of an importable package. It is named by the environment variable TEHL_PLUGINS (several with a
colon between them; TEHL_ENTRIES is its older name), by `plugins = [...]` in a scene file, or by an entry point
`tehl_taichi.plugins` of an installed package. Worker processes inherit the variable. Registries are read once, so a plugin must
be known before. Files whose names begin with an underscore are not read.
"""

import functools
import hashlib
import importlib.metadata
import importlib.util
import os
import sys
import tomllib
from pathlib import Path

from tehl_taichi.errors import SceneError

VARIABLE, OLDER, KEY, GROUP, PREFIX = "TEHL_PLUGINS", "TEHL_ENTRIES", "plugins", "tehl_taichi.plugins", "tehl_plugins."
LARGEST = 10**7  # bytes of a file that is read; a larger one is refused by whoever reads it


def folders():
    """{folder: text of its origin} of all plugins. Raises SceneError for a missing folder."""
    named = {_folder(name, variable): variable for variable in (VARIABLE, OLDER)
             for name in os.environ.get(variable, "").split(os.pathsep) if name}
    return {**{_folder(value, f"entry point {name}"): f"entry point {name}" for name, value in _entry_points()}, **named}


@functools.cache
def _entry_points():
    """(name, package) of the entry points of installed packages."""
    return tuple((point.name, point.value) for point in importlib.metadata.entry_points(group=GROUP))


def _folder(name, who, beside=None):
    """Folder of a plugin; beside: folder of the file that names it. Raises SceneError."""
    for path in ((beside or Path()) / name, *_package(name)):
        if os.path.isdir(path):
            return path.absolute()
    raise SceneError(f"{who} = {name!r} is neither a folder nor a package that Python finds; correct it, or omit it")


def _package(name):
    """Folders of a package by its name, without importing it; [] if Python does not find it."""
    try:
        spec = importlib.util.find_spec(name) if name.replace(".", "").isidentifier() else None
    except (ImportError, ValueError):
        spec = None
    return [Path(one) for one in (spec.submodule_search_locations or ())] if spec else []


def modules(subfolder):
    """Generator of the modules in a subfolder of all plugins, sorted by name. Raises SceneError."""
    for folder in folders():
        for path in sorted((folder / subfolder).glob("[!_]*.py")):
            yield _loaded(f"{PREFIX}{folder.name}_{_digest(folder)}.{subfolder}.{path.stem}", path)


def _digest(folder):
    return hashlib.sha256(os.fsencode(folder)).hexdigest()[:8]


def use_plugins_of(path):
    """Register the plugins of a scene file (or of the scene that a gear, bearing or study file names) before any registry is
    read.

    Other files are ignored. Raises SceneError for a plugin that does not exist, or is named too late.
    """
    path = Path(path)
    data = _toml(path)
    use(data.get(KEY, []), path)
    scene = data.get("scene")
    if isinstance(scene, str) and scene.endswith(".toml") and scene != path.name:
        use(_toml(path.parent / scene).get(KEY, []), path.parent / scene)


def _toml(path):
    """Dictionary of a TOML file, {} for other files."""
    if not path.name.lower().endswith(".toml") or not os.path.isfile(path) or path.stat().st_size > LARGEST:
        return {}
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, RecursionError):
        return {}


def use(names, path):
    """Register the plugins named in the file `path`; folders are relative to it. Raises SceneError."""
    if not isinstance(names, list) or not all(isinstance(name, str) and name for name in names):
        raise SceneError(f"{KEY} = {names!r} in {path} must be a list of folders or packages, as in [\"mylaws\"]")
    given = [_folder(name, KEY, path.absolute().parent) for name in names]
    new = [folder for folder in given if folder not in folders()]
    if new and getattr(sys.modules.get("tehl_taichi.values.registry"), "started", []):
        raise SceneError(f"{KEY} = {names!r} in {path} come too late: the laws of this process are already read; set "
                         f"{VARIABLE}={new[0]} before, or load this scene first")
    if new:
        os.environ[VARIABLE] = os.pathsep.join([*filter(None, [os.environ.get(VARIABLE)]), *map(str, new)])


def loaded_modules():
    """Plugin modules loaded so far."""
    return [module for name, module in sorted(sys.modules.items()) if name.startswith(PREFIX)]


def unread_files():
    """Python files directly in a plugin's folder, where none is read."""
    return sorted(path for folder in folders() for path in folder.glob("*.py") if path.name != "__init__.py")


def _loaded(name, path):
    if name in sys.modules:
        return sys.modules[name]
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise SceneError(f"{path} is not a Python file")
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:  # whatever a file of the user raises
        del sys.modules[name]
        raise SceneError(f"{path} cannot be loaded ({type(error).__name__}: {error}); correct it, or omit its "
                         "plugin") from error
    return module
