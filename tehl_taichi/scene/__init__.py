"""What the user describes: frozen dataclasses in SI units, checked when they are made. No taichi here.

The package itself can be called, `tehl_taichi.scene("gear")`, because the public function and this folder share a name.
"""

import sys
from types import ModuleType

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.builtin import BUILT_INS, scene  # last: the function must win over the submodule of its name
from tehl_taichi.scene.whole import Scene

__all__ = ["BUILT_INS", "Scene", "SceneError", "scene"]


class _CallablePackage(ModuleType):
    def __call__(self, name="gear"):
        return scene(name)


sys.modules[__name__].__class__ = _CallablePackage
