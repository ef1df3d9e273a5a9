"""Cracks below a feature: where tension opens the surface, which way a crack grows, with oil inside.

`symmetry_plane` holds the stresses of a passage, `trajectory` follows the largest tension, `growth` extends a crack.
`dislocations`, `elements`, `stiffness`, `compliance` are the elastic crack; `closure`, `face_friction` the contact of its
faces; `fluid_filled` and `fillings` its content; `analysis` runs both sides of the feature with `crack_options`.
May import: engine, values, laws, scene, fatigue.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tehl_taichi.crack.analysis import CrackResult
    from tehl_taichi.scene import Scene

__all__ = ["crack"]


def crack(of: Any, scene: "Scene | None" = None, *, thermal_stress: bool | None = None, threads: int | None = None,
          **options: Any) -> "CrackResult":
    """Compute crack paths: see :func:`tehl_taichi.crack`."""
    from tehl_taichi.crack.analysis import run
    from tehl_taichi.crack.crack_options import options_of
    from tehl_taichi.engine import runtime
    from tehl_taichi.fatigue.overrides import agreed, changed, reader_of

    chosen, reader = options_of(options), reader_of(of, "crack")
    scene = changed(agreed(scene, reader), {"thermal_stress": thermal_stress})
    runtime.start_or_join(threads=threads)
    return run(scene, reader, chosen)
