"""Where a crack goes under the loads of a passage: trajectories of the largest tension, and a crack whose faces may touch.

`plane` holds the stresses below the feature, `trajectory` follows them; `dislocations`, `elements`, `stiffness` and `faces` are
an elastic crack, `bounds`, `closure` and `rubbing` the contact of its faces, `growth` lets it grow, `answer` is the whole. May
import `fatigue` and what that may; nothing here knows of films or files but a table of residual stress.
"""

from typing import TYPE_CHECKING, Any

from tehl_taichi.called import callable_room

if TYPE_CHECKING:
    from tehl_taichi.crack.answer import CrackResult
    from tehl_taichi.scene import Scene

__all__ = ["crack"]


def crack(run: Any, scene: "Scene | None" = None, **wanted: Any) -> "CrackResult":
    """Crack paths from both sides of the feature of a stored run: a :class:`tehl_taichi.crack.answer.CrackResult`.

    run: a :class:`tehl_taichi.Run`, an opened store, or a list of snapshots with their `scene`; wanted: see
    :class:`tehl_taichi.crack.wanted.Wanted`. Raises SceneError where there is no passage, no plane of symmetry, or a value out
    of range.

    >>> import tehl_taichi as tehl
    >>> tehl.crack("gear-1.zarr", side="left")
    Traceback (most recent call last):
    ...
    tehl_taichi.errors.SceneError: side = 'left' is not known; allowed: entry, exit, both (did you mean 'exit'?)
    """
    from tehl_taichi.crack.answer import run as follow
    from tehl_taichi.crack.wanted import Wanted

    return follow(getattr(run, "store", run) if scene is None else (scene, run), Wanted(**wanted))


callable_room(__name__, crack)
