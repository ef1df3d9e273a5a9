"""What the user describes: frozen dataclasses in SI units, checked when they are made.

Bodies, oil, features, operation, grid, and what follows from them alone: Hertz units, film formulas, routes, doubts. Shapes of
`features`, named `oils`: a file each. May import `values`, `physics` and `criteria` (which laws there are); needs no taichi.
"""

from tehl_taichi.errors import SceneError
from tehl_taichi.scene.builtin import BUILT_INS, scene
from tehl_taichi.scene.whole import Scene

__all__ = ["BUILT_INS", "Scene", "SceneError", "scene"]
