"""Small stores without a solver: made-up snapshots on the grid of a scene."""

from types import SimpleNamespace

import numpy as np

from tehl_taichi.scene import scene

SMALL = scene("gear").replace(**{"grid.nx": 32, "grid.ny": 8, "thermal.on": False})


def shot(step, description=SMALL):
    """A snapshot whose every number tells its step."""
    from tehl_taichi.march.step_output import fields_of, scalars_of

    shape = description.grid.nx + 1, description.rows + 1
    fields = {name: np.full(shape, step + 1.5) for name in fields_of(description)}
    scalars = {name: step + 0.25 for name in scalars_of(description)}
    return SimpleNamespace(step=step, time=1e-6 * step, feature_x=1e-5 * step, x=np.arange(shape[0]) * 1e-5,
                           y=np.arange(shape[1]) * 1e-5, fields=fields, scalars=scalars,
                           state={"step": step, "P": np.zeros(shape[::-1]), "H0": 0.0})


def store(path, entries=3, description=SMALL, **attrs):
    """A closed store of so many entries."""
    from tehl_taichi.store.store import Store

    attrs = {"runtime": '{"precision": "f64"}', "steady_error": "{}", **attrs}
    with Store.create(path, description, shot(0), 50, attrs) as made:
        for step in range(1, entries):
            made.append(shot(step), shot(step).state)
    return made
