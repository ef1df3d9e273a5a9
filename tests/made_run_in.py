"""A run-in that is made up: a body whose top sank, with compression below it."""

import numpy as np

from tehl_taichi.plastic.run_in import BodyRunIn, RunInState
from tehl_taichi.plastic.steel_body import SteelState

X, Y, DEPTHS = np.linspace(-2e-4, 2e-4, 21), np.linspace(0, 1e-4, 5), np.array([5e-6, 1.5e-5, 3e-5, 6e-5])
RECORD = {"judged": False, "rounds": 3, "surface_change_m": 3e-7, "new_plastic_strain": 1e-3,
          "new_by_surface": {"a": 1e-3, "b": 2e-4}}


def body(sinks, stress=5e8):
    """The :class:`BodyRunIn` whose middle sank by `sinks` (m), under compression up to `stress` (Pa); 0: elastic."""
    hill = np.exp(-(X[:, None] ** 2 + Y**2) / 5e-9)
    deep = np.exp(-DEPTHS / 1e-5)[:, None, None, None]
    residual = -stress * (sinks > 0) * hill * deep * np.arange(6, 0, -1)[:, None, None] / 6
    start = SteelState(0 * residual, residual[:, 0] * -1e-12, residual, sinks * hill)
    return BodyRunIn(X, Y, DEPTHS, True, start, sinks * hill)


def flowed():
    """The :class:`RunInState` after one passage, in which body a sank by 0.3 um and body b by a thirtieth of that."""
    judged = {**RECORD, "passage": 2, "judged": True, "surface_change_m": 0.0, "new_plastic_strain": 1e-5,
              "new_by_surface": {"a": 1e-5, "b": 0.0}}
    bodies = {"a": body(3e-7), "b": body(1e-8, 2e8)}
    return RunInState(bodies, passages=1, records=({**RECORD, "passage": 1}, judged), done=True)


def elastic():
    """The state where nothing flowed."""
    record = {"passage": 1, "judged": True, "rounds": 1, "surface_change_m": 0.0, "new_plastic_strain": 0.0}
    return RunInState({"a": body(0.0)}, records=(record,), done=True)
