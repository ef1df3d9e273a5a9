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
    from tehl_taichi.march import state_origin
    from tehl_taichi.march.passage import march as run
    from tehl_taichi.scene.builtin import scene_or_builtin

    scene = scene_or_builtin(scene)
    if state is not None:
        _check_state(scene, state)
        state_origin.check(state, scene)
    changed = scene if precision is None else scene.replace(**{"numerics.precision": precision})
    return state_origin.recorded(run(changed, state), scene)


def _check_state(scene, state):
    """Refuse anything but a state of a snapshot on the nodes of the scene. Raises SceneError."""
    from tehl_taichi.errors import SceneError
    from tehl_taichi.values.coerce import shown

    if not isinstance(state, dict) or not {"step", "P", "H0", "load"} <= state.keys():
        raise SceneError(f"state = {shown(state)} is not the state of a snapshot; allowed: `snapshot.state` of this scene")
    nodes = scene.rows + 1, scene.grid.nx + 1
    for key, shape in {"P": nodes, **({} if scene.isothermal else {"heat_T": (scene.thermal.nodes, *nodes)})}.items():
        if (found := getattr(state.get(key), "shape", None)) != shape:
            what = f"an array of the shape {found}" if found else "no array"
            raise SceneError(f"the state has {what} for {key}, the scene needs {shape}; it belongs to another scene")


def __getattr__(name):
    """Attribute under its name before version 0.9."""
    if name != "simulate":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    import warnings

    from tehl_taichi.api import simulate

    warnings.warn("tehl_taichi.march.simulate is tehl_taichi.simulate", DeprecationWarning, stacklevel=2)
    return simulate
