"""What the user describes: frozen dataclasses in SI units, checked when they are made. No taichi here."""

from tehl_taichi.scene.builtin import BUILT_INS, scene
from tehl_taichi.scene.checks import SceneError
from tehl_taichi.scene.scene import Scene

__all__ = ["BUILT_INS", "Scene", "SceneError", "scene"]
