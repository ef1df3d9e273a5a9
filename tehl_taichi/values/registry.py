"""Registries: one entry, one idea. A law, a shape, a criterion, an oil, an output field is made by one declaration in one file.

Whoever offers choices (scenes, their template, suites, documentation) reads the entries of a folder by :func:`collect`; a new
file in that folder is a new choice.
"""

import importlib
import itertools
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from tehl_taichi.values import own_entries


@dataclass(frozen=True)
class Checked:
    """A number known from elsewhere: compute() must give `expected` within the relative error `rel`; where: who knows it."""

    where: str
    expected: float
    compute: Callable[[], float]
    rel: float = 1e-9


@dataclass(frozen=True, kw_only=True)
class Entry:
    """What every entry has: its name in scenes, one line of what it is (with units and range where it has numbers of its own),
    its source, and at least one number that a test computes again."""

    name: str
    says: str
    source: str
    checked: tuple[Checked, ...]


def collect(folder, kind):
    """{name: entry} of all entries of this kind that the modules of a folder (a package), and those of the user
    (:mod:`tehl_taichi.values.own_entries`), declare, in the order of their names.

    Raises ValueError when two entries have one name.
    """
    found: dict[str, Any] = {}
    names = sorted(name for _, name, _ in pkgutil.iter_modules(folder.__path__))
    own = (importlib.import_module(f"{folder.__name__}.{name}") for name in names)
    for module in itertools.chain(own, own_entries.modules(folder.__name__.rpartition(".")[2])):
        for entry in vars(module).values():
            if isinstance(entry, kind) and found.setdefault(entry.name, entry) is not entry:
                raise ValueError(f"{folder.__name__} has two entries named {entry.name!r}")
    return dict(sorted(found.items()))
