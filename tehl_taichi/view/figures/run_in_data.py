"""Profile of a run-in along the middle of a body, for figures and reports."""

from dataclasses import dataclass

import numpy as np

from tehl_taichi.values.arrays import nearest_index
from tehl_taichi.values.digits import number_of

COMPONENTS = {0: "σ_xx", 1: "σ_yy"}  # of the residual stress, by their place
DEEP = 0.02  # of the largest residual stress: deeper layers have less and are not shown


@dataclass(frozen=True)
class RunInProfile:
    """Profile of a body in its plane y = 0 (or the row next to it). body: its name; x (m) and heights (m) before and after;
    depths (m); residual: {"σ_xx": (x, depths) Pa, ...}.
    """

    body: str
    x: np.ndarray
    before: np.ndarray
    after: np.ndarray
    depths: np.ndarray
    residual: dict

    @property
    def largest(self):
        """Largest absolute residual stress (Pa), 1 without any."""
        return max(np.abs(values).max() for values in self.residual.values()) or 1.0


def profiles(scene, state):
    """The :class:`RunInProfile` of each body whose steel flowed, that of the largest change first; of a
    :class:`tehl_taichi.plastic.run_in.RunInState` that has bodies. Without flow that of one body.
    """
    order = sorted(state.bodies.items(), key=lambda one: -np.abs(one[1].start.sinking).max())
    return [_profile(scene, *one) for n, one in enumerate(order) if not n or one[1].start.hardened.any()]


def _profile(scene, name, body):
    row = nearest_index(body.y, 0.0)
    features = next(surface for surface in scene.surfaces if surface.name == name).features
    before = sum((f.height_at(body.x - f.x, body.y[row] - f.y) for f in features), np.zeros(body.x.size))
    stress = body.start.residual[..., row][:, list(COMPONENTS)]  # layers, components, x
    last = int(np.flatnonzero(np.abs(stress).max(axis=(1, 2)) >= DEEP * (np.abs(stress).max() or 1.0)).max(initial=2)) + 1
    return RunInProfile(name, body.x, before, before - body.start.sinking[:, row], body.depths[:last],
                        {words: stress[:last, n].T for n, words in enumerate(COMPONENTS.values())})


def added_strains(found, records):
    """{body: largest plastic strain that each passage adds} of these profiles and the records of a state."""
    return {one.body: [record["new_by_surface"][one.body] for record in records] for one in found}


def title(scene, state, found):
    """Title with the scene, the bodies of these profiles, and the number of passages."""
    count = f"{number_of(state.passages, 'passage')} before the one that is judged"
    bodies = " and ".join(one.body for one in found)
    whose = f"bod{'ies' if len(found) > 1 else 'y'} {bodies}"
    return f"{scene.name}: run-in of {whose}, {count if state.passages else 'no steel yields'}"
