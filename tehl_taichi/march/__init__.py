"""A run of a scene in memory: the steady start, then the passage step by step, and how good its numbers are.

`passage` marches in `rounds`; `start` begins (`steady`, `first_film`, `settle`, `together`); `prediction` and `guess` look
ahead, `failure` says what went wrong; `snapshot` is what comes out, an entry of `outputs/` for each field and number;
`readings`, `error_bars` and `companions` are its error bars. May import all rooms of physics; nothing here knows of files.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tehl_taichi.called import callable_room

if TYPE_CHECKING:
    from tehl_taichi.march.snapshot import Snapshot
    from tehl_taichi.scene import Scene

__all__ = ["march", "simulate"]


def march(scene: "Scene", state: dict | None = None, precision: str | None = None) -> "Iterator[Snapshot]":
    """Generator of snapshots of `scene`: the steady start, then one per time step (for loops of one's own).

    scene: a Scene, or the name of a built-in one; state: of the snapshot to go on from, taken from it (`snapshot.state`) while
    it is the newest; precision: "f32" or "f64", of the linear solves, instead of the scene's own (`numerics.precision`). Every
    scene runs in its own, in any order. A snapshot has fields (nx+1, ny+1) and scalars in SI, see
    :class:`tehl_taichi.march.snapshot.Snapshot`.
    Raises SceneError at once for another precision, NotConverged when a step fails for good: the snapshots before it are good.

    >>> import tehl_taichi as tehl
    >>> scene = tehl.scene("gear").replace(**{"grid.nx": 64, "grid.ny": 16, "thermal.on": False, "time.steps": 2})
    >>> for snapshot in tehl.march(scene):
    ...     print(snapshot.step, snapshot.fields["film"].shape, f"{snapshot.scalars['p_max_Pa'] / 1e9:.2f} GPa")
    0 (65, 17) 1.93 GPa
    1 (65, 17) 1.93 GPa
    2 (65, 17) 1.93 GPa
    """
    from tehl_taichi.errors import SceneError
    from tehl_taichi.march.passage import march as run
    from tehl_taichi.scene.builtin import given

    scene = given(scene)
    if state is not None and (found := tuple(state["P"].shape)) != (wanted := (scene.rows + 1, scene.grid.nx + 1)):
        raise SceneError(f"the state has {found[1]} x {found[0]} nodes, the scene {wanted[1]} x {wanted[0]}: it is not of this "
                         "scene")
    return run(scene if precision is None else scene.replace(**{"numerics.precision": precision}), state)


def simulate(scene: "Scene", precision: str | None = None) -> "list[Snapshot]":
    """All snapshots of `scene` as a list; arguments and errors as of :func:`march`. Long runs are better streamed: by that, or
    by :func:`tehl_taichi.run` into a store.

    >>> import tehl_taichi as tehl
    >>> steady, = tehl.simulate(tehl.scene("smooth-line").replace(**{"grid.nx": 32, "thermal.on": False}))
    >>> steady.fields["film"].shape, f"{steady.scalars['h_c_m'] * 1e6:.2f} um"
    ((33, 1), '0.43 um')
    """
    return list(march(scene, precision=precision))


callable_room(__name__, march)
