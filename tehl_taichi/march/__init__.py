"""A run in memory: steady start, time steps of the passage, snapshots, and the accuracy of their numbers.

`passage` marches, `coupling` iterates pressure and temperature; `start`, `steady`, `isothermal_start`, `alternating_start` and
`pseudo_transient` find the first state; `extrapolation` predicts the next step, `failure` explains a failed one. `outputs`
lists fields and numbers of a step; `accuracy` estimates errors. May import: engine, values, laws, scene, pressure, heat,
fatigue. No files.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tehl_taichi.march.snapshot import Snapshot
    from tehl_taichi.scene import Scene

__all__ = ["march"]


def march(scene: "Scene | str", state: dict | None = None, precision: str | None = None) -> "Iterator[Snapshot]":
    """March through a scene: see :func:`tehl_taichi.march`."""
    from tehl_taichi.errors import SceneError
    from tehl_taichi.march.passage import march as run
    from tehl_taichi.scene.builtin import scene_or_builtin
    from tehl_taichi.values.coerce import shown

    scene = scene_or_builtin(scene)
    if state is not None:
        if not isinstance(state, dict) or "P" not in state:
            raise SceneError(f"state = {shown(state)} is not the state of a snapshot; allowed: `snapshot.state` of this scene")
        if (found := tuple(state["P"].shape)) != (nodes := (scene.rows + 1, scene.grid.nx + 1)):
            raise SceneError(f"the state has {found[1]} x {found[0]} nodes, the scene {nodes[1]} x {nodes[0]}; it belongs to "
                             "another scene")
    return run(scene if precision is None else scene.replace(**{"numerics.precision": precision}), state)


def __getattr__(name):
    """Attribute under its name before version 0.9."""
    if name != "simulate":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    import warnings

    from tehl_taichi.api import simulate

    warnings.warn("tehl_taichi.march.simulate is tehl_taichi.simulate", DeprecationWarning, stacklevel=2)
    return simulate
