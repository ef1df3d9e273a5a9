"""Fatigue of the material: critical planes of stress histories at and below the surface, and the fatigue index.

`assessment` runs it for a passage, `given_histories` for stresses from elsewhere; `findley` searches planes
(`critical_planes`). `depth_search` finds the worst depth; `stress` computes the stresses; `overrides` are constants that differ
from the scene. May import: engine, values, laws, scene.
"""

from typing import TYPE_CHECKING, Any

from tehl_taichi.values.checks import callback

if TYPE_CHECKING:
    from tehl_taichi.fatigue.given_histories import Points
    from tehl_taichi.fatigue.search_result import SearchResult
    from tehl_taichi.scene import Scene

__all__ = ["fatigue"]


def fatigue(of: Any, scene: "Scene | None" = None, *, progress: Any = None, threads: int | None = None,
            until: float | None = None, **constants: Any) -> "SearchResult | Points":
    """Search fatigue: see :func:`tehl_taichi.fatigue`."""
    callback("progress", progress, "stage", "an object derived from tehl_taichi.Progress, or None")
    if scene is None and hasattr(of, "store"):  # a Run knows up to where its grid resolves the pressure, and its error bars
        return of.fatigue(progress=progress, threads=threads, until=until, **constants)

    from tehl_taichi.engine import runtime
    from tehl_taichi.fatigue import assessment, given_histories
    from tehl_taichi.fatigue import overrides as given
    from tehl_taichi.scene import SceneError
    from tehl_taichi.values.coerce import shown

    if given_histories.are_stresses(of):
        if until is not None:
            raise SceneError(f"until = {shown(until)} has no effect on given stresses: no feature passes")
        limits = given.of_points(constants, scene)
        runtime.start_or_join(threads=threads)
        return given_histories.search(of, limits)
    reader = given.reader_of(of, "fatigue")
    scene = given.changed(given.agreed(scene, reader), constants)
    runtime.start_or_join(threads=threads)
    notify = progress and (lambda done, total: progress.stage("stresses and fatigue", done, total))
    return assessment.run(scene, reader, notify, until)
