"""A run of a scene in memory: the steady start, then the passage step by step, and how good its numbers are.

`passage` marches; `start` begins (`steady`, `first_film`, `settle`); `prediction` and `guess` look ahead, `failure` says what went
wrong; `snapshot` is what comes out, an entry of `outputs/` for each field and number; `readings`, `error_bars` and `companions`
are its error bars. May import all rooms of physics; nothing here knows of files, but a companion's own process.
"""

from tehl_taichi.called import callable_room

__all__ = ["march"]


def march(scene, state=None, precision=None):
    """Generator of snapshots of `scene`: the steady start, then one per time step (for loops of one's own).

    state: of the snapshot to go on from; precision: "f32" or "f64", of the linear solves, instead of the scene's own
    (`numerics.precision`). Every scene runs in its own, in any order.
    """
    from tehl_taichi.march.passage import march as run

    return run(scene if precision is None else scene.replace(**{"numerics.precision": precision}), state)


callable_room(__name__, march)
