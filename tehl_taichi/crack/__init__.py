"""Where a crack goes under the loads of a passage: trajectories of the largest tension, and a crack whose faces may touch.

`plane` holds the stresses below the feature, `trajectory` follows them; `dislocations`, `elements`, `stiffness`, `compliance`
are an elastic crack, `bounds`, `closure` and `rubbing` the contact of its faces, `wet` and `fillings` what is inside, `growth`
lets it grow, `answer` is the whole. May import `fatigue`, `physics` and what they may; nothing here knows of films, or of files
but a table of residual stress.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tehl_taichi.crack.answer import CrackResult
    from tehl_taichi.scene import Scene

__all__ = ["crack"]


def crack(of: Any, scene: "Scene | None" = None, *, thermal_stress: bool | None = None, threads: int | None = None,
          **wanted: Any) -> "CrackResult":
    """As :func:`tehl_taichi.crack`."""
    from tehl_taichi.crack.answer import run
    from tehl_taichi.crack.wanted import Wanted
    from tehl_taichi.engine import runtime
    from tehl_taichi.fatigue.constants import agreed, changed, reader_of

    asked, reader = Wanted(**wanted), reader_of(of, "crack")
    scene = changed(agreed(scene, reader), {"thermal_stress": thermal_stress})
    runtime.start_or_join(threads=threads)
    return run(scene, reader, asked)
