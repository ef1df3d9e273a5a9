"""The scene: frozen dataclasses in SI units, checked when they are made, their files, and all that follows from them alone.

`sections` are the tables of a scene file, `description` the whole scene, `overrides` and `aliases` changes by key. `hertz`,
`scales`, `film_formula` compute from a scene; `scene_warnings` collects warnings; `surface` holds shapes and maps. May import:
disk, values, laws. Taichi is not loaded.
"""

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.builtin import BUILT_INS, scene
from tehl_taichi.scene.description import Scene

__all__ = ["BUILT_INS", "Scene", "SceneError", "scene"]
