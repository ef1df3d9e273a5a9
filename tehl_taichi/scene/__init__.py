"""What the user describes: frozen dataclasses in SI units, checked when they are made. No taichi here.

The package itself can be called, `tehl_taichi.scene("gear")`: function and folder share a name, and importing the folder would
replace a mere function of the package (`import tehl_taichi.scene as s` and `tehl_taichi.scene.Scene` must work, too).
"""

import sys
from types import ModuleType

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.builtin import BUILT_INS, scene
from tehl_taichi.scene.whole import Scene

__all__ = ["BUILT_INS", "Scene", "SceneError", "scene"]


class _CallablePackage(ModuleType):
    def __call__(self, name="gear"):
        return scene(name)


sys.modules[__name__].__class__ = _CallablePackage
