"""Folders of the package that can be called: `tehl.march(scene)` is a function, `tehl_taichi.march.steady` a module beside it.

Importing a folder sets its name in the package, where it would replace a mere function of that name.
"""

import inspect
import sys
from types import ModuleType


class _Room(ModuleType):
    def __call__(self, *args, **options):
        return self.called(*args, **options)


def callable_room(name, function):
    """Let the folder `name` (its `__name__`) be called as `function`."""
    room = sys.modules[name]
    room.__class__, room.called, room.__signature__ = _Room, function, inspect.signature(function)
