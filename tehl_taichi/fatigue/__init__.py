"""What the passage does to the material: stresses at and below the surface, critical planes, the fatigue index.

`half_space`, `rectangle`, `row_stress` (elastic), `thermal_stress`, `thermal_depth`; `histories` of material points; `findley`
searches by one of `criteria`, its kernels are in `critical_planes`, `circle`, with fewer moments by `thinning`, `deciding`;
`assessment` is the whole of a passage, `points` that of stress histories from elsewhere, `constants` what can be changed of
them. Rests on `criteria`, `scene` and `engine` alone. `tehl_taichi.fatigue(run)` is the function.
"""

from typing import TYPE_CHECKING, Any

from tehl_taichi.called import callable_room

if TYPE_CHECKING:
    from tehl_taichi.fatigue.assessment import FatigueResult
    from tehl_taichi.fatigue.points import Points
    from tehl_taichi.scene import Scene

__all__ = ["fatigue"]


def fatigue(of: Any, scene: "Scene | None" = None, *, progress: Any = None, threads: int | None = None,
            until: float | None = None, **constants: Any) -> "FatigueResult | Points":
    """Fatigue of a run again, of snapshots, or of stress histories from elsewhere; what it is of stays as it is.

    of: a :class:`tehl_taichi.Run`, with a scene that differs in its fatigue alone; or snapshots of `scene` (as
    :func:`tehl_taichi.march` yields them); or, perhaps with a scene whose constants are taken, stresses (points,
    times, 6) in Pa: xx, yy, zz, xy, xz, yz with z into or out of the surface, one point also as (times, 6).
    constants: any of the scene's section [fatigue] (kappa, endurance in Pa, criterion, depths in m, from_x and to_x in a,
    thermal_stress, residual_xx ...; None: as it is), or in place of endurance a limit in reversed bending or torsion,
    with both of kappa, too (bending_limit, torsion_limit, Pa). progress: see :class:`tehl_taichi.Progress`; threads: as of
    :func:`tehl_taichi.run`; until: position (a) of the feature, the worst points up to there are told apart ("resolved" of the
    summary; of a Run: where its grid resolves the pressure no longer).
    Returns a :class:`tehl_taichi.fatigue.assessment.FatigueResult`, of stresses :class:`tehl_taichi.fatigue.points.Points`.
    Raises SceneError for constants out of range, without a passage, or for stresses of another shape. Source: Findley 1959
    (the other criteria: see :func:`tehl_taichi.fatigue.findley.search`).

    Reversed bending of 100 MPa along x: f = (sigma/2)(kappa + sqrt(1 + kappa^2)).

    >>> import numpy as np
    >>> bending = np.zeros((3, 6))
    >>> bending[:, 0] = 100e6, -100e6, 0.0
    >>> found = fatigue(bending, kappa=0.3, endurance=400e6)
    >>> print(f"{found.f[0] / 1e6:.2f} MPa, Fi {found.Fi[0]:.3f}")
    67.20 MPa, Fi 0.168
    """
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


callable_room(__name__, fatigue)
