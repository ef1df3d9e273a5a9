"""Registries: one entry, one idea. A law, a shape, a criterion, an oil, an output field is made by one declaration in one file.

Whoever offers choices (scenes, their template, suites, documentation) reads the entries of a folder by :func:`collect`; a new
file in that folder is a new choice.
"""

import importlib
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


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
    """{name: entry} of all entries of this kind that the modules of a folder (a package) declare, in the order of their names.

    Raises ValueError when two entries have one name.
    """
    found: dict[str, Any] = {}
    for module in sorted(name for _, name, _ in pkgutil.iter_modules(folder.__path__)):
        for entry in vars(importlib.import_module(f"{folder.__name__}.{module}")).values():
            if isinstance(entry, kind) and found.setdefault(entry.name, entry) is not entry:
                raise ValueError(f"{folder.__name__} has two entries named {entry.name!r}")
    return dict(sorted(found.items()))
