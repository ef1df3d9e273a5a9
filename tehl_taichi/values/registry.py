"""Registries: one entry per idea. A law, a shape, a criterion, an oil, an output field is made by one declaration in one file.

Modules that offer choices (scenes, their template, suites, documentation) read the entries of a folder by :func:`collect`; a
new file in that folder is a new choice.
"""

import importlib
import itertools
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from tehl_taichi.errors import SceneError
from tehl_taichi.values import plugins

started: set[str] = set()  # folders that were read: their choices do not change afterwards


@dataclass(frozen=True)
class Checked:
    """A known number: compute() must give `expected` within the relative error `rel`; where: its source."""

    where: str
    expected: float
    compute: Callable[[], float]
    rel: float = 1e-9


@dataclass(frozen=True, kw_only=True)
class Entry:
    """Fields of every entry: its name in scenes, a one-line description (with units and ranges of its numbers), its source, and
    at least one known number that a test computes again.
    """

    name: str
    says: str
    source: str
    checked: tuple[Checked, ...]


def collect(folder, kind):
    """{name: entry} of all entries of this kind in the modules of a folder (a package) and in the user's modules
    (:mod:`tehl_taichi.values.plugins`), sorted by name.

    Raises SceneError if two entries have one name, or a file of the user has no entry.
    """
    started.add(folder.__name__)
    found: dict[str, Any] = {}
    names = sorted(name for _, name, _ in pkgutil.iter_modules(folder.__path__))
    installed = (importlib.import_module(f"{folder.__name__}.{name}") for name in names)
    for module in itertools.chain(installed, _with_entries(folder.__name__.rpartition(".")[2], kind)):
        for entry in entries_of(module, kind):
            if found.setdefault(entry.name, entry) is not entry:
                raise SceneError(f"{module.__file__}: name = {entry.name!r} belongs to another entry of {folder.__name__}; "
                                 "choose another name")
    return dict(sorted(found.items()))


def entries_of(module, kind=Entry):
    """Entries of this kind that a module declares."""
    return [entry for entry in vars(module).values() if isinstance(entry, kind)]


def _with_entries(subfolder, kind):
    """Generator of the user's modules. Raises SceneError for one without an entry."""
    for module in plugins.modules(subfolder):
        if not entries_of(module):
            raise SceneError(f"{module.__file__} has no entry; assign a {kind.__name__}(name=...) to a name of the module, or "
                             "begin the name of the file with an underscore")
        yield module
