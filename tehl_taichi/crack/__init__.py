"""Where a crack goes under the loads of a passage: trajectories of the largest tension, and a crack whose faces may touch.

`plane` holds the stresses below the feature, `trajectory` follows them; `dislocations`, `elements`, `stiffness`, `compliance`
are an elastic crack, `bounds`, `closure` and `rubbing` the contact of its faces, `wet` and `fillings` what is inside, `growth`
lets it grow, `answer` is the whole. May import `fatigue`, `physics` and what they may; nothing here knows of films, or of files
but a table of residual stress.
`tehl_taichi.crack(run)` is the function.
"""

from typing import TYPE_CHECKING, Any

from tehl_taichi.called import callable_room

if TYPE_CHECKING:
    from tehl_taichi.crack.answer import CrackResult
    from tehl_taichi.scene import Scene

__all__ = ["crack"]


def crack(of: Any, scene: "Scene | None" = None, *, thermal_stress: bool | None = None, threads: int | None = None,
          **wanted: Any) -> "CrackResult":
    """Crack paths from both sides of the feature, under the loads of its passage; what they are of stays as it is.

    of: a :class:`tehl_taichi.Run`, or snapshots of `scene` (as :func:`tehl_taichi.march` yields them). thermal_stress: as of
    :func:`tehl_taichi.fatigue`; threads: as of :func:`tehl_taichi.run`; wanted: see
    :class:`tehl_taichi.crack.wanted.Wanted` (side, start, angle, length, threshold, residual, face_friction, oil ...).
    Raises SceneError where nothing passes, y = 0 is no plane of symmetry, or a value is out of range. Sources: Hannes &
    Alfredsson 2011 (trajectories), Hills, Kelly, Dai & Korsunsky 1996 (cracks as dislocations), Erdogan & Sih 1963 (growth).

    >>> import tehl_taichi as tehl
    >>> tehl.crack([], tehl.scene("gear"), side="left")
    Traceback (most recent call last):
    ...
    tehl_taichi.errors.SceneError: side = 'left' is not known; allowed: entry, exit, both (did you mean 'exit'?)
    """
    from tehl_taichi.crack.answer import run
    from tehl_taichi.crack.wanted import Wanted
    from tehl_taichi.engine import runtime
    from tehl_taichi.fatigue.constants import agreed, changed, reader_of

    asked, reader = Wanted(**wanted), reader_of(of, "crack")
    scene = changed(agreed(scene, reader), {"thermal_stress": thermal_stress})
    runtime.start_or_join(threads=threads)
    return run(scene, reader, asked)


callable_room(__name__, crack)
