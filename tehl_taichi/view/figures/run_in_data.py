"""Profile of a run-in along the middle of a body, for figures and reports."""

from dataclasses import dataclass

import numpy as np

COMPONENTS = {0: "σ_xx", 1: "σ_yy"}  # of the residual stress, by their place
DEEP = 0.02  # of the largest residual stress: deeper layers have less and are not shown


@dataclass(frozen=True)
class RunInProfile:
    """Profile of the body whose surface changed most, in its plane y = 0 (or the row next to it). name; x (m) and heights (m)
    before and after; depths (m); residual: {"σ_xx": (x, depths) Pa, ...}.
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


def profile(scene, state):
    """The :class:`RunInProfile` of a :class:`tehl_taichi.plastic.run_in.RunInState` that has bodies."""
    name, body = max(state.bodies.items(), key=lambda one: np.abs(one[1].start.sinking).max())
    row = int(np.argmin(np.abs(body.y)))
    features = next(surface for surface in scene.surfaces if surface.name == name).features
    before = sum((f.height_at(body.x - f.x, body.y[row] - f.y) for f in features), np.zeros(body.x.size))
    stress = body.start.residual[..., row][:, list(COMPONENTS)]  # layers, components, x
    last = int(np.flatnonzero(np.abs(stress).max(axis=(1, 2)) >= DEEP * (np.abs(stress).max() or 1.0)).max(initial=2)) + 1
    return RunInProfile(name, body.x, before, before - body.start.sinking[:, row], body.depths[:last],
                        {words: stress[:last, n].T for n, words in enumerate(COMPONENTS.values())})


def title(scene, state, body):
    """Title with the scene, the body, and the number of passages."""
    count = f"{state.passages} passage{'s' * (state.passages != 1)} before the one that is judged"
    return f"{scene.name}: run-in of body {body}, {count if state.passages else 'no steel yields'}"
