"""Entries of the user: files in the folder TEHL_ENTRIES, in subfolders named as the package's (shear, shapes, oils ...).

Files whose names begin with an underscore are not read.
"""

import importlib.util
import os
import sys
from pathlib import Path

from tehl_taichi.errors import SceneError

VARIABLE, PREFIX = "TEHL_ENTRIES", "tehl_entries."


def modules(subfolder):
    """Generator of the modules in a subfolder of the user's folder, in the order of their names. Raises SceneError."""
    root = os.environ.get(VARIABLE)
    if not root:
        return
    if not Path(root).is_dir():
        raise SceneError(f"{VARIABLE} = {root!r} is not a folder; correct it, or unset it")
    for path in sorted(Path(root, subfolder).glob("[!_]*.py")):
        yield _loaded(f"{PREFIX}{subfolder}.{path.stem}", path)


def loaded():
    """The modules of the user that were loaded so far."""
    return [module for name, module in sorted(sys.modules.items()) if name.startswith(PREFIX)]


def unread():
    """Python files that lie in the user's folder itself, where none is read."""
    root = os.environ.get(VARIABLE)
    return sorted(Path(root).glob("*.py")) if root else []


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
        raise SceneError(f"{path} cannot be loaded ({type(error).__name__}: {error}); correct it, or unset "
                         f"{VARIABLE}") from error
    return module
