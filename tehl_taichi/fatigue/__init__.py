"""What the passage does to the material: stresses at and below the surface, critical planes, the fatigue index.

`half_space`, `rectangle`, `row_stress` (elastic), `thermal_stress`, `thermal_depth`; `histories` of material points; `findley`
searches by one of `criteria`, its kernels are in `critical_planes`, `circle`, with fewer moments by `thinning`, `deciding`;
`assessment` is the whole of a passage, `points` that of stress histories from elsewhere, `constants` what can be changed of
them. Rests on `criteria`, `scene` and `engine` alone.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tehl_taichi.fatigue.assessment import FatigueResult
    from tehl_taichi.fatigue.points import Points
    from tehl_taichi.scene import Scene

__all__ = ["fatigue"]


def fatigue(of: Any, scene: "Scene | None" = None, *, progress: Any = None, threads: int | None = None,
            until: float | None = None, **constants: Any) -> "FatigueResult | Points":
    """As :func:`tehl_taichi.fatigue`."""
    if scene is None and hasattr(of, "store"):  # a Run knows up to where its grid resolves the pressure, and its error bars
        return of.fatigue(progress=progress, threads=threads, until=until, **constants)

    from tehl_taichi.engine import runtime
    from tehl_taichi.fatigue import assessment, points
    from tehl_taichi.fatigue import constants as given

    if points.are_stresses(of):
        limits = given.of_points(constants, scene)
        runtime.start_or_join(threads=threads)
        return points.search(of, limits)
    reader = given.reader_of(of, "fatigue")
    scene = given.changed(given.agreed(scene, reader), constants)
    runtime.start_or_join(threads=threads)
    tell = progress and (lambda done, total: progress.stage("stresses and fatigue", done, total))
    return assessment.run(scene, reader, tell, until)
