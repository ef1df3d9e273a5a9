"""What the package offers: names that are imported when they are asked for, and folders that can be called.

`tehl.march(scene)` is a function, `tehl_taichi.march.steady` a module beside it: importing a folder sets its name in the
package, where it would replace a mere function of that name.
"""

import importlib
import inspect
import sys
from types import ModuleType


class _Room(ModuleType):
    def __call__(self, *args, **options):
        return self.called(*args, **options)

    @property
    def called(self):
        module, _, name = self.calls
        return getattr(importlib.import_module(module), name)

    @property
    def __signature__(self):
        return inspect.signature(self.called)


def callable_room(name, function):
    """Let the folder `name` (its `__name__`) be called as `function`, or as what "module.function" names."""
    room = sys.modules[name]
    room.calls = function.rpartition(".") if isinstance(function, str) else (name, ".", function.__name__)
    room.__class__ = _Room


def offered(package, names, rooms):
    """The `__getattr__` of `package`: names {name: module that has it} and folders, imported when they are asked for."""
    def found(name):
        if name in rooms:
            return importlib.import_module(f"{package}.{name}")
        if name not in names:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(importlib.import_module(f"{package}.{names[name]}"), name)
        setattr(sys.modules[package], name, value)
        return value

    return found
