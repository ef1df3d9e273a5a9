"""A run of a scene in memory: the steady start, then the passage step by step, and how good its numbers are.

`passage` marches in `rounds`; `start` begins (`steady`, `first_film`, `settle`, `together`); `prediction` and `guess` look
ahead, `failure` says what went wrong; `snapshot` is what comes out, an entry of `outputs/` for each field and number;
`readings`, `error_bars` and `companions` are its error bars. May import all rooms of physics; nothing here knows of files.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tehl_taichi.march.snapshot import Snapshot
    from tehl_taichi.scene import Scene

__all__ = ["march"]


def march(scene: "Scene", state: dict | None = None, precision: str | None = None) -> "Iterator[Snapshot]":
    """As :func:`tehl_taichi.march`."""
    from tehl_taichi.errors import SceneError
    from tehl_taichi.march.passage import march as run
    from tehl_taichi.scene.builtin import given

    scene = given(scene)
    if state is not None and (found := tuple(state["P"].shape)) != (wanted := (scene.rows + 1, scene.grid.nx + 1)):
        raise SceneError(f"the state has {found[1]} x {found[0]} nodes, the scene {wanted[1]} x {wanted[0]}; it belongs to "
                         "another scene")
    return run(scene if precision is None else scene.replace(**{"numerics.precision": precision}), state)


def __getattr__(name):
    """Its name before version 0.9."""
    if name != "simulate":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    import warnings

    from tehl_taichi.api import simulate

    warnings.warn("tehl_taichi.march.simulate is tehl_taichi.simulate", DeprecationWarning, stacklevel=2)
    return simulate
