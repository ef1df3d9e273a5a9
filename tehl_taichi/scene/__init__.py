"""What the user describes: frozen dataclasses in SI units, checked when they are made.

Bodies, oil, features, operation, grid, and what follows from them alone: Hertz units, film formulas, routes, doubts. Shapes of
`features`, named `oils`: a file each. May import `values`, `physics` and `criteria` (which laws there are); needs no taichi.
`tehl_taichi.scene("gear")` is the built-in scene of that name.
"""

from tehl_taichi.called import callable_room
from tehl_taichi.errors import SceneError
from tehl_taichi.scene.builtin import BUILT_INS, scene
from tehl_taichi.scene.whole import Scene

__all__ = ["BUILT_INS", "Scene", "SceneError", "scene"]

callable_room(__name__, "tehl_taichi.io.found.find")  # in files too, of which this folder knows nothing
